#include "actors/mapobjects_store/map_port.hpp"

namespace godwit::mapobjects_store {

map_result<void> map_port::open(const map_writer_options& options, runtime::gateway gateway, wake_handle actor) {
  // All of it is called in the writer's one thread, and so shares one gateway.
  const auto way_in = std::make_shared<runtime::gateway>(std::move(gateway));
  const std::function<void()> wake_actor = [way_in, actor = std::move(actor)] {
    way_in->tell(actor, mapobjects_store::wake{});
  };
  auto woken = options;
  woken.on_health_change = [wake_actor, further = options.on_health_change](const map_writer_status& now) {
    wake_actor();
    if (further)
      further(now);
  };
  auto writer = map_writer::open(woken);
  if (!writer) {
    attach(tl::unexpected(writer.error()), {});
    return tl::unexpected(std::move(writer.error()));
  }
  attach(std::shared_ptr<map_access>(std::move(*writer)), wake_actor);
  return {};
}

void map_port::attach(map_result<std::shared_ptr<map_access>> map, std::function<void()> wake) {
  const std::lock_guard guard(mutex_);
  map_ = std::move(map);
  wake_ = std::move(wake);
}

void map_port::close() {
  map_result<std::shared_ptr<map_access>> closing =
      tl::unexpected(map_error{map_errc::closed, "the map is closed", {}});
  {
    const std::lock_guard guard(mutex_);
    std::swap(map_, closing);
  }
  closing = tl::unexpected(map_error{}); // its destructor waits for the writer, which answers into the box
}

map_result<map_writer_status> map_port::status() const {
  const auto there = map();
  if (!there)
    return tl::unexpected(there.error());
  return (*there)->status();
}

map_result<std::shared_ptr<map_access>> map_port::map() const {
  const std::lock_guard guard(mutex_);
  return map_;
}

void map_port::put(ready_answer answer) {
  if (!box_.put(std::move(answer)))
    return;
  std::function<void()> wake_actor;
  {
    const std::lock_guard guard(mutex_);
    wake_actor = wake_;
  }
  if (wake_actor)
    wake_actor();
}

} // namespace godwit::mapobjects_store
