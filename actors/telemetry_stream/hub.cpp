#include "actors/telemetry_stream/hub.hpp"

#include <algorithm>
#include <utility>

#include "io/fields/json_text.hpp"

namespace godwit::telemetry_stream {
namespace {

constexpr std::size_t index_of(topic what) { return static_cast<std::size_t>(what); }

std::string hello_text(std::uint64_t session) {
  return R"({"topic":"stream","data":{"session":")" + std::to_string(session) + R"("}})";
}

std::string drops_text(const topic_counts& dropped) {
  std::string result = R"({"topic":"stream","data":{"dropped":{)";
  const char* before = "\"";
  for (std::size_t i = 0; i < topic_count; ++i)
    if (dropped[i] != 0) {
      result.append(before).append(io::name_of(static_cast<topic>(i))).append("\":").append(std::to_string(dropped[i]));
      before = ",\"";
    }
  return result + "}}}";
}

} // namespace

// -- subscriber -----------------------------------------------------------------------------------

subscriber::subscriber(const queue_bounds& bounds, std::function<void()> on_ready)
    : bounds_(bounds), on_ready_(std::move(on_ready)) {}

subscriber::entry subscriber::pop(queue& from) {
  auto result = std::move(from.texts.front());
  from.texts.pop_front();
  from.bytes -= result.text->size();
  return result;
}

bool subscriber::put(const entry& each, std::int64_t now_ns, hub_counts& counts) {
  const std::lock_guard guard(mutex_);
  auto& its = wants_[index_of(each.what)];
  if (!its.is_wanted || has_ended_ || now_ns < its.next_ns)
    return false;
  its.next_ns = its.interval_ns == 0 ? 0 : now_ns + its.interval_ns;
  const bool is_event = must_arrive(each.what);
  auto& to = is_event ? events_ : data_;
  to.texts.push_back(each);
  to.bytes += each.text->size();
  if (is_event && (to.texts.size() > bounds_.max_events || to.bytes > bounds_.max_event_bytes)) {
    has_ended_ = true;
    events_ = {};
    data_ = {};
    ++counts.ended;
  }
  while (!is_event && (to.texts.size() > bounds_.max_data || to.bytes > bounds_.max_data_bytes)) {
    const auto what = pop(to).what;
    ++dropped_[index_of(what)];
    ++counts.dropped[index_of(what)];
    has_drops_ = true;
  }
  return !std::exchange(is_told_, true) || has_ended_;
}

text_ptr subscriber::take() {
  const std::lock_guard guard(mutex_);
  if (data_.texts.empty() && events_.texts.empty()) {
    is_told_ = false;
    return nullptr;
  }
  if (std::exchange(has_drops_, false)) {
    topic_counts news{};
    for (std::size_t i = 0; i < topic_count; ++i)
      news[i] = dropped_[i] - std::exchange(told_[i], dropped_[i]);
    return std::make_shared<const std::string>(drops_text(news));
  }
  const bool is_event =
      data_.texts.empty() || (!events_.texts.empty() && events_.texts.front().number < data_.texts.front().number);
  return pop(is_event ? events_ : data_).text;
}

bool subscriber::has_ended() const {
  const std::lock_guard guard(mutex_);
  return has_ended_;
}

topic_counts subscriber::dropped() const {
  const std::lock_guard guard(mutex_);
  return dropped_;
}

std::size_t subscriber::waiting_bytes() const {
  const std::lock_guard guard(mutex_);
  return data_.bytes + events_.bytes;
}

// -- hub ------------------------------------------------------------------------------------------

text_ptr hub::publish(topic what, const std::string& data, std::int64_t wall_ms, std::int64_t now_ns) {
  const std::lock_guard guard(mutex_);
  std::string text = R"({"topic":")";
  text.append(io::name_of(what)).append(R"(","number":)").append(std::to_string(++number_));
  text.append(R"(,"at_ms":)").append(std::to_string(wall_ms)).append(R"(,"data":)").append(data).append("}");
  const subscriber::entry made{number_, what, std::make_shared<const std::string>(std::move(text))};
  newest_[index_of(what)] = made;
  ++counts_.published[index_of(what)];
  std::erase_if(subscribers_, [&](const std::weak_ptr<subscriber>& each) {
    const auto who = each.lock();
    if (who && who->put(made, now_ns, counts_))
      who->on_ready_();
    return !who;
  });
  return made.text;
}

tl::expected<std::shared_ptr<subscriber>, std::string>
hub::subscribe(const std::vector<wanted_topic>& wanted, std::function<void()> on_ready, const queue_bounds& bounds) {
  const std::lock_guard guard(mutex_);
  std::erase_if(subscribers_, [](const std::weak_ptr<subscriber>& each) { return each.expired(); });
  if (subscribers_.size() >= max_subscribers)
    return tl::make_unexpected("there are " + std::to_string(max_subscribers) + " subscribers already");
  const std::shared_ptr<subscriber> made(new subscriber(bounds, std::move(on_ready)));
  made->wants_[index_of(topic::clock)].is_wanted = true;
  for (const auto& each : wanted)
    made->wants_[index_of(each.what)] = {true, must_arrive(each.what) ? 0 : each.interval_ns, 0};
  greet(*made);
  subscribers_.push_back(made);
  return made;
}

// The newest of each topic as it was said, with its time: what is old looks old.
void hub::greet(subscriber& who) {
  who.data_.texts.push_back({0, topic::clock, std::make_shared<const std::string>(hello_text(session_))});
  who.data_.bytes += who.data_.texts.back().text->size();
  auto all = newest_;
  std::ranges::sort(all, {}, &subscriber::entry::number);
  for (const auto& each : all)
    if (each.text)
      (void)who.put(each, 0, counts_);
  who.is_told_ = false;
}

hub_counts hub::counts() const {
  const std::lock_guard guard(mutex_);
  auto result = counts_;
  result.subscribers = static_cast<std::uint64_t>(
      std::ranges::count_if(subscribers_, [](const std::weak_ptr<subscriber>& each) { return !each.expired(); }));
  return result;
}

} // namespace godwit::telemetry_stream
