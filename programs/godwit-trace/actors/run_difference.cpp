#include "programs/godwit-trace/actors/run_difference.hpp"

#include <algorithm>
#include <functional>

#include <nlohmann/json.hpp>

namespace godwit::trace_tool {

namespace {

using nlohmann::json;

constexpr std::uint64_t spread = 0x9e37'79b9'7f4a'7c15;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return (a ^ (b + spread + (a << 6U) + (a >> 2U))) * spread; }

std::uint64_t hash(std::string_view text) { return std::hash<std::string_view>{}(text); }

void remove_fields(json& from, const std::vector<std::string>& names) {
  if (from.is_object())
    for (const auto& each : names)
      from.erase(each);
  if (from.is_structured())
    for (auto& each : from)
      remove_fields(each, names);
}

// The place in B's streams of the stream of that name; none: B has no such stream.
const compared_run::stream* same_stream(const compared_run& in, const std::string& name) {
  const auto found = std::ranges::find(in.streams(), name, &compared_run::stream::name);
  return found == in.streams().end() ? nullptr : &*found;
}

struct candidate {
  std::size_t stream = 0;
  std::size_t index = 0;
  std::int64_t since_ns = 0;
};

// Where the entries of two streams differ first; none: they are the same.
std::optional<std::size_t> first_other(const std::vector<compared_run::entry>& a,
                                       const std::vector<compared_run::entry>& b) {
  const auto [in_a, in_b] = std::ranges::mismatch(a, b);
  return in_a == a.end() && in_b == b.end() ? std::nullopt : std::optional(static_cast<std::size_t>(in_a - a.begin()));
}

// All that differs in A, stream by stream, and the oldest place of it.
class comparison {
public:
  comparison(const compared_run& a, const compared_run& b) : a_(a), b_(b), parts_(a.streams().size()) {
    for (std::size_t n = 0; n < a.streams().size(); ++n)
      compare(n);
    for (const auto& each : b.streams())
      if (same_stream(a, each.name) == nullptr && !each.entries.empty())
        note_stream_of_b(each);
  }

  [[nodiscard]] std::optional<difference> result() {
    difference found;
    found.streams_that_differ = count_;
    if (only_in_b_ != nullptr) {
      found.stream = only_in_b_->name;
      found.b_number = only_in_b_->entries.front().number;
      return found;
    }
    if (!oldest_)
      return std::nullopt;
    follow_back(found);
    found.stream = a_.streams()[oldest_->stream].name;
    found.index = oldest_->index;
    if (const auto* entry = entry_of(*oldest_))
      found.a_number = entry->number;
    const auto* const theirs = same_stream(b_, found.stream);
    if (theirs != nullptr && oldest_->index < theirs->entries.size())
      found.b_number = theirs->entries[oldest_->index].number;
    return found;
  }

private:
  static constexpr std::size_t max_steps = 1'000;

  void compare(std::size_t n) {
    static const std::vector<compared_run::entry> nothing;
    const auto& mine = a_.streams()[n].entries;
    const auto* const stream = same_stream(b_, a_.streams()[n].name);
    const auto& theirs = stream == nullptr ? nothing : stream->entries;
    parts_[n] = first_other(mine, theirs);
    if (!parts_[n])
      return;
    ++count_;
    const auto since_ns = *parts_[n] < mine.size() ? mine[*parts_[n]].since_ns : theirs[*parts_[n]].since_ns;
    if (!oldest_ || since_ns < oldest_->since_ns)
      oldest_ = {n, *parts_[n], since_ns};
  }
  void note_stream_of_b(const compared_run::stream& each) {
    ++count_;
    const auto since_ns = each.entries.front().since_ns;
    const bool is_older = only_in_b_ == nullptr || since_ns < only_in_b_->entries.front().since_ns;
    if (is_older && (!oldest_ || since_ns < oldest_->since_ns))
      only_in_b_ = &each;
  }
  [[nodiscard]] const compared_run::entry* entry_of(const candidate& at) const {
    const auto& entries = a_.streams()[at.stream].entries;
    return at.index < entries.size() ? &entries[at.index] : nullptr;
  }
  // A cause that differs, too, is nearer to the origin: the clocks of two threads may disagree about what was first.
  void follow_back(difference& found) {
    std::unordered_map<std::uint64_t, candidate> begins; // of the differing parts, by id
    for (std::size_t n = 0; n < parts_.size(); ++n)
      if (parts_[n])
        if (const auto* entry = entry_of({n, *parts_[n], 0}); entry != nullptr && entry->id != 0)
          begins.emplace(entry->id, candidate{n, *parts_[n], entry->since_ns});
    while (found.a_symptoms.size() < max_steps) {
      const auto* const entry = entry_of(*oldest_);
      const auto cause = entry == nullptr ? begins.end() : begins.find(entry->cause);
      if (cause == begins.end())
        return;
      found.a_symptoms.push_back(entry->number);
      oldest_ = cause->second;
    }
  }

  const compared_run& a_;
  const compared_run& b_;
  std::vector<std::optional<std::size_t>> parts_; // index from which on a stream of A differs
  std::optional<candidate> oldest_;
  const compared_run::stream* only_in_b_ = nullptr; // a stream that A does not have, older than all of A's differences
  std::size_t count_ = 0;                           // streams that differ
};

} // namespace

std::uint64_t compared_run::hash_of(std::string_view body) const {
  if (ignored_.empty())
    return hash(body);
  auto document = json::parse(body, nullptr, false);
  if (document.is_discarded())
    return hash(body);
  remove_fields(document, ignored_);
  return hash(document.dump(-1, ' ', false, json::error_handler_t::replace));
}

compared_run::stream& compared_run::stream_of(const runtime::delivery& each, const runtime::name_table& names) {
  const auto key = (std::uint64_t{each.actor} << 32U) | each.sender;
  const auto [found, is_new] = places_.try_emplace(key, streams_.size());
  if (is_new)
    streams_.push_back({names.name(each.actor) + " <- " + names.name(each.sender), {}});
  return streams_[found->second];
}

void compared_run::add(const runtime::delivery& each, const runtime::name_table& names) {
  if (count_ == 0)
    begin_ns_ = each.began_ns;
  while (type_hashes_.size() < names.size())
    type_hashes_.push_back(hash(names.name(static_cast<std::uint32_t>(type_hashes_.size()))));
  const auto content = mixed(mixed(type_hashes_[each.type], hash_of(each.body)), static_cast<std::uint64_t>(each.how));
  stream_of(each, names).entries.push_back({content, each.id, each.cause, each.began_ns - begin_ns_, count_++});
}

std::optional<difference> first_difference(const compared_run& a, const compared_run& b) {
  return comparison(a, b).result();
}

} // namespace godwit::trace_tool
