// Joins the map to the actor: asks are handed over to whoever works on the map, answers are put into a box, and the
// actor is woken when there is something in it.
//
//   auto port = std::make_shared<map_port>();
//   auto map = actors.add<mapobjects_store::actor>({.name = "mapobjects_store"}, policy, port);
//   actors.start();
//   if (auto opened = port->open(options, actors.make_gateway("map_writer"), map); !opened) ...
//
// It outlives the incarnations of the actor, so that a crash of the actor closes no file and loses no work. A map that
// can not be opened is no reason not to fly: then each ask is answered with why. Close it before the actors are
// stopped. Thread: open, attach and close by the owner; the rest from any.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "actors/mapobjects_store/map_writer.hpp"
#include "actors/mapobjects_store/response_queue.hpp"
#include "messages/mapobjects_store/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::mapobjects_store {

class map_port {
public:
  map_port() = default;
  map_port(const map_port&) = delete;
  map_port& operator=(const map_port&) = delete;
  ~map_port() { close(); }

  // Opens the file and starts its writer; blocks on the disk. The error is that of map_writer::open, and is also what
  // each ask is answered with from now on.
  [[nodiscard]] map_result<void> open(const map_writer_options& options, runtime::gateway gateway, wake_handle actor);

  // The same with a map that is open already; WAKE is called when there is something in the box.
  void attach(map_result<std::shared_ptr<map_access>> map, std::function<void()> wake);

  // What waits is written within the writer's close timeout.
  void close();

  // START(map, done) hands the ask over; FILL is that of answer_from. Nothing: the answer will be in the box. Otherwise
  // it was not taken, and this is the answer.
  template <class Answer, class Value, class Start, class Fill>
  [[nodiscard]] std::optional<Answer> ask(std::uint64_t request_id, Answer empty, const Start& start, Fill fill);

  [[nodiscard]] std::optional<ready_answer> take() { return box_.take(); }

  // How the writer is; the error when there is no map.
  [[nodiscard]] map_result<map_writer_status> status() const;

private:
  [[nodiscard]] map_result<std::shared_ptr<map_access>> map() const;
  void put(ready_answer answer);

  mutable std::mutex mutex_; // guards the next two
  map_result<std::shared_ptr<map_access>> map_ =
      tl::unexpected(map_error{map_errc::full, "the map is not open yet", "Ask again"});
  std::function<void()> wake_;
  response_queue box_;
};

template <class Answer, class Value, class Start, class Fill>
std::optional<Answer> map_port::ask(std::uint64_t request_id, Answer empty, const Start& start, Fill fill) {
  const auto there = map();
  if (!there)
    return refusal(std::move(empty), there.error());
  if (!box_.reserve())
    return refusal(
        std::move(empty),
        {map_errc::full, "more than " + std::to_string(response_queue::max_asks) + " asks wait", "Ask again"});
  const auto done = [this, request_id, empty, fill = std::move(fill)](const map_result<Value>& result) {
    put({request_id, answer_from(empty, result, fill)});
  };
  if (auto handed_over = start(**there, done); !handed_over) {
    box_.give_back();
    return refusal(std::move(empty), handed_over.error());
  }
  return std::nullopt;
}

} // namespace godwit::mapobjects_store
