// The way to the missions service, as the actor sees it: a call goes out, an answer comes into the box.
//
// It outlives the incarnations of the actor. A number is never used twice in the life of a port, so that an answer to a
// call of an incarnation that has died is known as such. Thread: send and cancel by the actor; answers from any.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "actors/mission_client/response_queue.hpp"

namespace godwit::mission_client {

struct service_call {
  bool is_post = false;
  std::string target{}; // path and query below the service's address, percent-encoded
  std::string body{};
  std::string key{};     // the idempotency key of a POST; it is in the body too
  std::string picture{}; // a file of the folder of pictures, whose bytes become the empty `jpeg` at the end of the body
  std::size_t max_answer_bytes = 0; // unpacked
  bool is_page = false; // of the map: it may come compressed, and name the next one before (ending::page_begun)
  std::chrono::milliseconds read_timeout{0};  // without a byte
  std::chrono::milliseconds total_timeout{0}; // from sending to the end of the answer
};

class service_port {
public:
  service_port() = default;
  service_port(const service_port&) = delete;
  service_port& operator=(const service_port&) = delete;
  virtual ~service_port() = default;

  // The number of the call. Exactly one answer with this number comes into the box later, unless it is cancelled
  // or the process ends; before that of a page one page_begun may come.
  [[nodiscard]] virtual std::uint64_t send(service_call call) = 0;
  // Nobody waits for the answer any more; it may come all the same.
  virtual void cancel(std::uint64_t number) = 0;
  // The same for all calls: they are of an incarnation that has died.
  virtual void cancel_all() = 0;

  [[nodiscard]] response_queue& answers() { return answers_; }

private:
  response_queue answers_;
};

} // namespace godwit::mission_client
