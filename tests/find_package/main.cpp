#include <cstdio>

#include "core/rows.h"
#include "core/units.h"

int main() {
  const std::string rows = fathom::format_rows({{"fill", fathom::metres_from_mm(30.0), "m"}}, false);
  std::fputs(rows.c_str(), stdout);
}
