#include "core/memory.h"

#include <malloc.h>

namespace fathom {

void keep_freed_pages() {
  constexpr int kLargestImage = 1 << 28, kKept = 1 << 30;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, kLargestImage);
  mallopt(M_TRIM_THRESHOLD, kKept);
}

}  // namespace fathom
