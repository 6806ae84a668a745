// How the process keeps memory between frames.
#pragma once

namespace fathom {

/// Tells the C library to keep the pages of freed images. A frame's images come and go by the megabyte; fetching them
/// anew from the kernel each time costs a fifth of the matcher's time. Threads share one store of them.
/// Call once, at the start of main.
void keep_freed_pages();

}  // namespace fathom
