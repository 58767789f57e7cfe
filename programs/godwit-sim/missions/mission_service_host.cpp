#include "programs/godwit-sim/missions/mission_service_host.hpp"

#include <utility>

#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/running_service.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"

namespace godwit::sim::missions {

class mission_service_host::running {
public:
  explicit running(std::unique_ptr<running_service> made) : service_(std::move(made)) {}

  // What WHAT gives for the service, in its thread.
  template <class What>
  auto inside(const What& what) {
    std::optional<decltype(what(*service_))> result;
    service_->thread().run_inside([&] { result = what(*service_); });
    return *std::move(result);
  }
  running_service& service() { return *service_; }

private:
  std::unique_ptr<running_service> service_;
};

mission_service_host::mission_service_host(std::unique_ptr<running> made) : running_(std::move(made)) {}
mission_service_host::~mission_service_host() = default;

tl::expected<std::unique_ptr<mission_service_host>, std::string> mission_service_host::open(service_settings settings,
                                                                                            teller tell) {
  auto opened = running_service::open(std::move(settings), std::move(tell));
  if (!opened)
    return tl::unexpected(std::move(opened.error()));
  return std::unique_ptr<mission_service_host>(new mission_service_host(std::make_unique<running>(*std::move(opened))));
}

std::uint16_t mission_service_host::port() const {
  return running_->inside([](running_service& service) { return service.port(); });
}

std::string mission_service_host::url() const {
  return running_->inside([](running_service& service) { return service.url(); });
}

std::string mission_service_host::control() const {
  return running_->inside([](running_service& service) { return service.control(); });
}

tl::expected<void, std::string> mission_service_host::set_fault(std::string_view spec) {
  return running_->inside([&](running_service& service) { return service.set_fault(spec); });
}

void mission_service_host::clear_faults() {
  running_->service().thread().run_inside([this] { running_->service().clear_faults(); });
}

tl::expected<mission::assignment, std::string> mission_service_host::assign(const std::string& mission_id,
                                                                            const assignment_request& wanted) {
  return running_->inside([&](running_service& service) { return service.assign(mission_id, wanted); });
}

tl::expected<void, std::string> mission_service_host::add_mission(const mission::document& mission) {
  return running_->inside([&](running_service& service) { return service.add_mission(mission); });
}

tl::expected<void, std::string> mission_service_host::delete_mission(const std::string& mission_id) {
  return running_->inside([&](running_service& service) { return service.delete_mission(mission_id); });
}

tl::expected<void, std::string> mission_service_host::set_map_objects(const std::string& mission_id,
                                                                      const std::vector<mission::map_object>& objects) {
  return running_->inside([&](running_service& service) {
    return service_operations::set_map_objects(service.file(), mission_id, objects);
  });
}

tl::expected<void, std::string>
mission_service_host::add_ignored_items(const std::string& mission_id,
                                        const std::vector<mission::ignored_item>& items) {
  return running_->inside([&](running_service& service) {
    return service_operations::add_ignored_items(service.file(), mission_id, items);
  });
}

std::optional<mission::document> mission_service_host::current_mission(const std::string& mission_id) {
  return running_->inside([&](running_service& service) { return service.current_mission(mission_id); });
}

std::vector<stored_row> mission_service_host::rows(const std::string& mission_id, row_kind kind) {
  return running_->inside([&](running_service& service) { return rows_of(service.file(), mission_id, kind); });
}

service_figures mission_service_host::figures() {
  return running_->inside([](running_service& service) { return service.figures(); });
}

void mission_service_host::wait() { running_->service().wait(); }

void mission_service_host::end() {
  running_->service().thread().run_inside([this] { running_->service().end(); });
}

} // namespace godwit::sim::missions
