// The missions service over HTTP or HTTPS: joins io/http to the actor.
//
//   auto service = http_service::open(where);            // an error is a sentence for people
//   auto client = actors.add<mission_client::actor>({.name = "mission_client"}, policy, settings{}, *service, others,
//   seed); actors.start(); (*service)->attach(actors.make_gateway("missions_service"), client);
//   ...
//   (*service)->close();
//   actors.stop();
//
// It decides nothing: what is tried again and when is the actor's business. The token stays in io/http. Thread: open,
// attach and close by the owner; the rest as service_port.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "actors/mission_client/service_port.hpp"
#include "io/http/client.hpp"
#include "messages/mission_client/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::mission_client {

// The long poll, the two map destinations, progress and a fetch can be under way at once, and an insert must not wait
// for any of them.
inline constexpr std::size_t min_connections = 8;

class http_service final : public service_port {
public:
  // Connects to nobody yet. WANTED.max_under_way is raised to min_connections.
  // PICTURES: the folder of what service_call::picture names; empty: there are none.
  [[nodiscard]] static tl::expected<std::shared_ptr<http_service>, std::string>
  open(io::http::settings wanted, std::filesystem::path pictures = {});
  ~http_service() override;

  // From now on the actor is woken when an answer comes. The gateway is used by the connection's thread alone.
  void attach(runtime::gateway gateway, wake_handle actor);
  // Ends what is under way. What it cuts off, and later calls, get no answer: the next process makes them again. Before
  // the actors are stopped.
  void close();

  [[nodiscard]] std::uint64_t send(service_call call) override;
  void cancel(std::uint64_t number) override;
  void cancel_all() override;

  [[nodiscard]] io::http::client_counters counters() const;

private:
  explicit http_service(std::filesystem::path pictures) : pictures_(std::move(pictures)) {}
  // With the lock. None: it is under way.
  [[nodiscard]] std::optional<service_answer> send_numbered(std::uint64_t number, service_call call);
  void take(std::uint64_t number, io::http::result<io::http::response> got);
  void take_head(std::uint64_t number, const io::http::response& head);
  void put(service_answer answer);

  const std::filesystem::path pictures_;
  mutable std::mutex mutex_; // over the next three; never held while a callback may run
  std::uint64_t next_number_ = 1;
  std::map<std::uint64_t, io::http::request_id> under_way_; // by number; bounded by what the client takes
  std::unique_ptr<io::http::client> client_;                // none after close()

  std::mutex waker_mutex_;
  std::optional<runtime::gateway> gateway_;
  std::optional<wake_handle> actor_;
};

} // namespace godwit::mission_client
