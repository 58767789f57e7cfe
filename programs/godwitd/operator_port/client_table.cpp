#include "programs/godwitd/operator_port/client_table.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace godwit::operator_port {

using boost::asio::ip::address;

class client_table::place final : public io::http::client_place {
public:
  place(std::shared_ptr<client_table> table, address from) : share(std::move(from)), of_(std::move(table)) {}
  ~place() override {
    const std::lock_guard guard(of_->mutex_);
    of_->places_.remove(this);
  }
  void prove(const std::string& with) override {
    const std::lock_guard guard(of_->mutex_);
    session = with;
  }

  const address share;
  std::string session; // with which it has come last; empty: none. Under the mutex of the table

private:
  const std::shared_ptr<client_table> of_;
};

std::shared_ptr<io::http::client_place> client_table::admit(const address& from) {
  const auto share = io::http::share_of(from);
  const auto most = share.is_loopback() ? max_clients_ : max_clients_ - max_clients_ / kept_part;
  std::unique_lock lock(mutex_);
  std::function<void()> end;
  if (const bool is_share_full = count_of(share) >= max_an_address_; is_share_full || places_.size() >= most) {
    auto* const leaves = is_share_full ? longest_without_session(share) : who_gives_way(share);
    if (leaves == nullptr)
      return nullptr;
    places_.remove(leaves);
    ++gave_way_;
    end = leaves->end_connection;
  }
  auto made = std::make_shared<place>(shared_from_this(), share);
  places_.push_back(made.get());
  lock.unlock(); // what ends may give its place back
  if (end)
    end();
  return made;
}

void client_table::end_session(const std::string& session) {
  std::vector<std::function<void()>> ended;
  {
    const std::lock_guard guard(mutex_);
    for (auto* each : places_) {
      if (each->session != session)
        continue;
      each->session.clear();
      if (each->is_websocket && each->end_connection)
        ended.push_back(each->end_connection);
    }
  }
  for (const auto& each : ended)
    each();
}

std::size_t client_table::count_of(const address& share) const {
  return static_cast<std::size_t>(std::ranges::count(places_, share, &place::share));
}

client_table::place* client_table::longest_without_session(const address& share) const {
  const auto found =
      std::ranges::find_if(places_, [&](const auto* each) { return each->share == share && each->session.empty(); });
  return found == places_.end() ? nullptr : *found;
}

// Clients of this computer give way to nobody from elsewhere.
client_table::place* client_table::who_gives_way(const address& share) const {
  place* result = nullptr;
  std::ptrdiff_t most = 0;
  for (auto* each : places_) {
    if (!each->session.empty() || (each->share.is_loopback() && !share.is_loopback()))
      continue;
    const auto its = std::ranges::count_if(
        places_, [&](const auto* other) { return other->share == each->share && other->session.empty(); });
    if (its > most) {
      result = each;
      most = its;
    }
  }
  return result;
}

std::size_t client_table::now() const {
  const std::lock_guard guard(mutex_);
  return places_.size();
}

std::uint64_t client_table::gave_way() const {
  const std::lock_guard guard(mutex_);
  return gave_way_;
}

} // namespace godwit::operator_port
