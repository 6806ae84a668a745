#include "core/memory.h"

#include <malloc.h>

namespace fathom {

void keep_freed_pages() {
  constexpr int kLargestImage = 1 << 28, kKept = 1 << 30;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, kLargestImage);
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_ARENA_MAX, 1);  // further arenas, one a thread, give their pages back whatever the threshold says
}

}  // namespace fathom
