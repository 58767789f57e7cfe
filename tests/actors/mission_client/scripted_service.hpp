// A missions service in virtual time, with the rules of the contract and faults on demand.
//
// It outlives the processes that speak to it. A call takes effect half-way between going out and its answer, so that a
// process that is killed meanwhile does not know. Idempotency keys are kept with the digest of the body: a known key
// with another body is answered with 422 and counted, because no client may ever do that. Rows have identities of their
// own; what comes again counts as repeated. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "actors/mission_client/service_port.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission_client::test {

// The end that one process holds. It dies with the process.
class scripted_port final : public service_port {
public:
  [[nodiscard]] std::uint64_t send(service_call call) override {
    sent.push_back({next_number_, std::move(call)});
    return next_number_++;
  }
  void cancel(std::uint64_t number) override { cancelled.push_back(number); }
  void cancel_all() override {
    for (std::uint64_t number = 1; number < next_number_; ++number)
      cancelled.push_back(number);
  }

  struct sent_call {
    std::uint64_t number = 0;
    service_call call;
  };
  std::vector<sent_call> sent; // not yet seen by the service
  std::vector<std::uint64_t> cancelled;

private:
  std::uint64_t next_number_ = 1;
};

// What goes wrong with a call.
enum class fault {
  none,
  no_connection, // nothing happens at the service
  lost_answer,   // it happens, and the answer is lost
  silence,       // nothing happens, and nothing comes until the client's time-out
  wrong_host,    // the certificate is somebody else's
  cut_answer,    // 200 with half of the JSON; it happens
  status_answer, // the status of the fault, and nothing happens
};

struct planned_fault {
  std::string where{}; // part of the target; empty: everywhere
  fault what = fault::no_connection;
  unsigned status = 503;
  std::int64_t retry_after_ns = 0; // 0: it does not say
  int times = 1'000'000'000;       // then it is used up
  bool posts_only = false;
  bool gets_only = false;
};

struct service_mission {
  mission::document document;
  bool is_deleted = false;
  std::vector<mission::progress_report> reports;
  std::vector<mission::assignment> assignments;                  // not responded to
  std::map<std::string, mission::assignment_response> responses; // by assignment
  std::map<std::string, mission::observation> observations;      // by id
  std::map<std::string, mission::ignored_item> ignored;          // by id
  std::vector<mission::map_object> map_objects;                  // what is pulled
  std::vector<mission::ignored_item> map_ignored;
  std::vector<std::vector<mission::map_object>> marked{}; // the map at each mark that was given
  int changes = 0;                                        // inserts and tails that took effect
  std::set<std::string> item_ids{};                       // that it has or had
};

class scripted_service {
public:
  service_mission& add(mission::document document);
  [[nodiscard]] service_mission& at(const std::string& id) { return missions.at(id); }
  // Takes what PORT has sent; what the port of a dead process had under way is forgotten, effects included.
  void run(const std::shared_ptr<scripted_port>& port, std::int64_t now_ns, const std::function<void()>& wake);
  void assign(const std::string& id, mission::assignment what) { at(id).assignments.push_back(std::move(what)); }
  void forget_pages() { page_tokens_ = false; }

  std::map<std::string, service_mission> missions;
  std::vector<planned_fault> faults;
  std::int64_t latency_ns = 20'000'000;
  std::uint32_t page_rows = 1'000'000;    // of a page at most, beside what is asked for
  std::int32_t numbers_by = 1;            // a change raises the revision by so much: others have changed it, too
  bool refuses_marks = false;             // 400 to each that it has given
  bool knows_progress_call = true;        // GET .../progress; an older service does not
  std::vector<std::string> next_missions; // missions of `vehicle`, which is given the first that has not ended
  std::string vehicle = "bird-1";
  std::string answers_for;      // another vehicle; empty: for who asks
  std::set<std::string> poison; // ids of observations that it will never take

  // What was seen.
  std::map<std::string, int> calls; // by "GET /missions/ID/..." without the query
  int other_bodies = 0;             // known keys with another body: never
  int unknown_items = 0;            // reports that name an item which the mission never had: never
  std::uint64_t repeated_rows = 0;
  int at_once = 0; // most posts of one lane that were under way at the same time: never above 1
  [[nodiscard]] int count(const std::string& part) const;
  [[nodiscard]] int posts(const std::string& part) const; // of these, those that deliver something

private:
  struct open_call {
    std::weak_ptr<scripted_port> port;
    std::uint64_t number = 0;
    service_call call;
    std::int64_t sent_ns = 0;
    planned_fault fault{.what = fault::none};
    std::optional<service_answer> answer; // it has happened
  };
  struct kept_answer {
    std::string body;
    service_answer answer;
  };

  void accept(const std::shared_ptr<scripted_port>& port, std::int64_t now_ns);
  [[nodiscard]] planned_fault take_fault(const service_call& call);
  [[nodiscard]] bool advance(open_call& each, std::int64_t now_ns);
  [[nodiscard]] std::optional<service_answer> handle(const service_call& call, bool may_wait);
  [[nodiscard]] std::optional<service_answer> next_of(const std::string& vehicle_id, bool may_wait) const;
  [[nodiscard]] service_answer handle_post(service_mission& m, const service_call& call, const std::string& rest);
  [[nodiscard]] service_answer page(service_mission& m, const std::string& rest, const std::string& query);
  template <class Cut>
  [[nodiscard]] service_answer page_since(service_mission& m, const std::string& since, const Cut& cut);
  static void note_items(service_mission& m);
  [[nodiscard]] service_answer take_progress(service_mission& m, const std::string& body);
  [[nodiscard]] service_answer take_change(service_mission& m, const service_call& call, bool is_tail);
  [[nodiscard]] service_answer take_response(service_mission& m, const std::string& id, const std::string& body);
  [[nodiscard]] service_answer take_map(service_mission& m, const std::string& body, bool is_ignored);

  std::deque<open_call> open_;
  std::map<std::string, kept_answer> kept_; // by idempotency key
  bool page_tokens_ = true;
};

// A mission with a take-off, COUNT waypoints w1, w2, ... and a return.
[[nodiscard]] mission::document sample_mission(const std::string& id, int waypoints = 3);
[[nodiscard]] mission::assignment sample_assignment(const mission::document& base, int number);
// A UUID with this number in it.
[[nodiscard]] std::string uuid(std::uint64_t number, char kind = 'a');
inline const std::string mission_a = uuid(1);
inline const std::string mission_b = uuid(2);

} // namespace godwit::mission_client::test
