// All parts of a running missions service, put together: the file, the service, its faults, the server, the control
// port. mission_service_host.hpp is the way in for those outside of its thread.
//
// Errors: open gives a sentence. Thread: that of the io_thread, for all but open, the destructor and wait.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <tl/expected.hpp>

#include "io/link/io_thread.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "programs/godwit-sim/host/control_port.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/fault_book.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"
#include "programs/godwit-sim/missions/figures.hpp"
#include "programs/godwit-sim/missions/service.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"
#include "programs/godwit-sim/missions/service_server.hpp"
#include "programs/godwit-sim/missions/settings.hpp"

namespace godwit::sim::missions {

class running_service {
public:
  using teller = std::function<void(std::string_view line)>;
  using done = tl::expected<void, std::string>;

  [[nodiscard]] static tl::expected<std::unique_ptr<running_service>, std::string> open(service_settings settings,
                                                                                        teller tell);
  ~running_service();
  running_service(const running_service&) = delete;
  running_service& operator=(const running_service&) = delete;

  [[nodiscard]] io::link::io_thread& thread() { return *thread_; }
  void wait() { ended_.get_future().wait(); }

  // -- inside only
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  [[nodiscard]] std::string url() const { return server_->url(); }
  [[nodiscard]] std::string control() const;
  [[nodiscard]] done set_fault(std::string_view spec);
  void clear_faults();
  [[nodiscard]] tl::expected<mission::assignment, std::string> assign(const std::string& mission_id,
                                                                      const assignment_request& wanted);
  [[nodiscard]] done add_mission(const mission::document& mission);
  [[nodiscard]] done delete_mission(const std::string& mission_id);
  [[nodiscard]] std::optional<mission::document> current_mission(const std::string& mission_id);
  // The only one that there is, and is not deleted; else a sentence.
  [[nodiscard]] tl::expected<std::string, std::string> only_mission();
  [[nodiscard]] service_figures figures();
  [[nodiscard]] service_file& file() { return *file_; }
  void end();

private:
  running_service(service_settings settings, teller tell);

  [[nodiscard]] done start();
  [[nodiscard]] done open_file();
  [[nodiscard]] done put_missions();
  [[nodiscard]] done start_server();
  void open_control();
  void control_answered(const std::string& failure);
  void refuse_for(std::chrono::nanoseconds time);
  void end_on_signals();

  service_settings settings_;
  teller teller_;
  std::shared_ptr<io::link::io_thread> thread_; // before all that lives in it
  std::unique_ptr<service_file> file_;
  std::optional<service> service_;
  fault_book faults_;
  std::optional<faulty_service> faulty_;
  std::optional<service_server> server_;
  std::unique_ptr<control_port> control_;
  std::promise<std::string> control_opened_; // the failure, or nothing
  bool control_has_answered_ = false;
  bool has_wrong_host_ = false;
  boost::asio::steady_timer refusal_;
  boost::asio::signal_set signals_;
  std::promise<void> ended_;
  bool has_ended_ = false;
};

} // namespace godwit::sim::missions
