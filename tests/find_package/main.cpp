#include <cstdio>

#include <fathom/core/rows.h>
#include <fathom/core/units.h>

int main() {
  const std::string rows = fathom::format_rows({{"fill", fathom::metres_from_mm(30.0), "m"}}, false);
  std::fputs(rows.c_str(), stdout);
}
