#include "core/watcher.h"

namespace fathom {
namespace {

thread_local Watcher* watching = nullptr;

}  // namespace

Watcher* watcher() { return watching; }

WatcherScope::WatcherScope(Watcher* watcher) : before_(watching) { watching = watcher; }

WatcherScope::~WatcherScope() { watching = before_; }

void go_on() {
  if (watching && watching->ends()) throw Ended();
}

}  // namespace fathom
