// The missions service of godwit-sim in virtual time, without HTTP: its real request handling on a database in memory,
// behind the port that the actor knows.
//
// It outlives the processes that speak to it. A request takes effect half-way between going out and its answer, also
// when its process has died meanwhile: it was on the wire. The words for faults are those of godwit-sim. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "actors/mission_client/picture_body.hpp"
#include "actors/mission_client/service_port.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/fault_book.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"
#include "programs/godwit-sim/missions/figures.hpp"
#include "programs/godwit-sim/missions/service.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::drill {

// The end that one process holds.
class simulated_service_port final : public mission_client::service_port {
public:
  struct sent_call {
    std::uint64_t number = 0;
    mission_client::service_call what;
  };

  explicit simulated_service_port(std::filesystem::path pictures) : pictures_(std::move(pictures)) {}

  [[nodiscard]] std::uint64_t send(mission_client::service_call call) override {
    if (!call.picture.empty() && !mission_client::put_picture(call, pictures_))
      put({.number = next_number_, .how = mission_client::ending::no_picture, .error = "there is no such picture"});
    else
      sent_.push_back({next_number_, std::move(call)});
    return next_number_++;
  }
  void cancel(std::uint64_t number) override { cancelled_.push_back(number); }
  void cancel_all() override {
    for (std::uint64_t number = first_open_; number < next_number_; ++number)
      cancelled_.push_back(number);
    first_open_ = next_number_;
  }

  // WAKE is called when an answer comes and the actor sleeps.
  void attach(std::function<void()> wake) { wake_ = std::move(wake); }
  void put(mission_client::service_answer answer) {
    if (answers().put(std::move(answer)))
      wake_();
  }
  [[nodiscard]] std::vector<sent_call> take_sent() { return std::exchange(sent_, {}); }
  [[nodiscard]] std::vector<std::uint64_t> take_cancelled() { return std::exchange(cancelled_, {}); }

private:
  const std::filesystem::path pictures_;
  std::function<void()> wake_;
  std::uint64_t next_number_ = 1;
  std::uint64_t first_open_ = 1; // that cancel_all has not met
  std::vector<sent_call> sent_;
  std::vector<std::uint64_t> cancelled_;
};

class simulated_service {
public:
  static constexpr std::int64_t latency_ns = 40'000'000; // there and back
  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

  // WALL_BEGAN_NS: since 1970, when virtual time is 0.
  explicit simulated_service(std::int64_t wall_began_ns);

  // Takes what PORT has sent. True: there was something.
  bool take_from(const std::shared_ptr<simulated_service_port>& port, std::int64_t now_ns);
  void on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  // -- its people
  void add_mission(const mission::document& what);
  void add_mission(const mission::document& what, std::int64_t now_ns); // while vehicles ask for it
  void set_map_objects(const std::string& mission_id, const std::vector<mission::map_object>& objects);
  // False: the wish makes no sense for the mission as it is.
  bool assign(const std::string& mission_id, const sim::missions::assignment_request& wanted, std::int64_t now_ns);
  // Somebody there puts another waypoint in front of the last item: another revision, of which the vehicle is not told.
  void revise(const std::string& mission_id, const mission::item& extra);
  void set_fault(std::string_view words);
  void clear_faults() { faults_.clear(); }

  // Nothing gets to it, and no answer from it, until then; who asked waits until his patience is over.
  void cut(std::int64_t until_ns) { cut_until_ns_ = until_ns; }

  // -- what it has
  [[nodiscard]] mission::document mission(const std::string& mission_id);
  [[nodiscard]] std::vector<sim::missions::stored_row> rows(const std::string& mission_id,
                                                            sim::missions::row_kind kind);
  [[nodiscard]] sim::missions::row_figures figures(sim::missions::row_kind kind);
  // Inserts and tails that took effect, each under a key of its own.
  [[nodiscard]] std::size_t changes(const std::string& mission_id) {
    return rows(mission_id, sim::missions::row_kind::change).size();
  }
  // Answers of this status to reports.
  [[nodiscard]] std::uint64_t answers_to_reports(unsigned status) const;

private:
  enum class stage { on_its_way, held, answered };
  struct open_call {
    std::weak_ptr<simulated_service_port> port;
    std::uint64_t number = 0;
    sim::missions::taken_call asked;
    std::size_t max_answer_bytes = 0;
    std::int64_t gives_up_ns = 0; // the client does
    stage at = stage::on_its_way;
    std::int64_t due_ns = 0;
    std::optional<sim::missions::delivery> answer = {};
  };

  [[nodiscard]] bool is_cut(std::int64_t now_ns) const { return now_ns < cut_until_ns_; }
  void advance(open_call& each, std::int64_t now_ns);
  void answer_polls(std::int64_t now_ns);
  void lose(open_call& each, std::int64_t now_ns);
  void answer(open_call& each, std::int64_t now_ns, sim::missions::patience how_long);
  void deliver(const open_call& each);

  std::int64_t wall_began_ns_;
  std::unique_ptr<sim::missions::service_file> file_;
  sim::missions::service service_;
  sim::missions::fault_book faults_;
  sim::missions::faulty_service faulty_;
  std::deque<open_call> open_;
  std::uint64_t assigned_ = 0;
  std::int64_t cut_until_ns_ = 0;
};

} // namespace godwit::drill
