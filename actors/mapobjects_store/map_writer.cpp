#include "actors/mapobjects_store/map_writer.hpp"

#include <mutex>
#include <thread>

#include "actors/mapobjects_store/write_loop.hpp"
#include "runtime/assert.hpp"

namespace godwit::mapobjects_store {

struct map_writer::parts {
  parts(const map_writer_options& options, std::unique_ptr<map_store> store)
      : queue(options.max_queued), loop(options, std::move(store), queue) {}

  work_queue queue;
  write_loop loop;
  std::mutex close_mutex;
  std::thread thread;
};

map_writer::map_writer(std::unique_ptr<parts> made) : parts_(std::move(made)) {
  parts_->thread = std::thread([this] { parts_->loop.run(); });
}

map_result<std::unique_ptr<map_writer>> map_writer::open(const map_writer_options& options) {
  auto store = map_store::open(options.store);
  if (!store)
    return tl::unexpected(std::move(store.error()));
  return std::unique_ptr<map_writer>(new map_writer(std::make_unique<parts>(options, std::move(*store))));
}

map_writer::~map_writer() { close(); }

map_result<void> map_writer::push(queued_work item) { return parts_->queue.push(std::move(item)); }

map_writer_status map_writer::status() const { return parts_->loop.status(); }

void map_writer::close() {
  GODWIT_ASSERT(std::this_thread::get_id() != parts_->thread.get_id(), "map: closed from one of its own callbacks");
  parts_->queue.close();
  std::lock_guard one_at_a_time(parts_->close_mutex);
  if (parts_->thread.joinable())
    parts_->thread.join();
}

} // namespace godwit::mapobjects_store
