// godwit-trace flow: what led to a message and what came of it, as a tree with times.
#include <algorithm>
#include <map>

#include "programs/godwit-trace/actors/cause_index.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::delivery;

struct flow_arguments {
  trace_arguments trace;
  std::uint64_t id = 0;
  std::size_t limit = 200;
};

struct kept_delivery {
  delivery what;
  std::string body;
};

// The deliveries of a family, and how they hang together.
class flow_tree {
public:
  void add(const delivery& each) {
    nodes_.push_back({each, std::string(each.body.substr(0, max_body_bytes))});
    by_cause_[each.cause].push_back(nodes_.size() - 1);
  }

  [[nodiscard]] const std::vector<kept_delivery>& nodes() const { return nodes_; }

  // Origins are those whose cause is not among them.
  void append_to(std::string& out, const runtime::name_table& names, const paint& colours, std::uint64_t marked) const {
    for (const auto& [cause, children] : by_cause_) {
      const bool is_origin =
          std::ranges::none_of(nodes_, [&](const auto& each) { return each.what.id == cause && cause != 0; });
      for (const auto child : children)
        if (is_origin)
          append(out, child, 0, names, colours, marked);
    }
  }

private:
  static constexpr std::size_t max_body_bytes = 160;
  static constexpr std::size_t max_depth = 64; // of a drawn tree; a deeper one goes on at the same depth

  void append(std::string& out, std::size_t at, std::size_t depth, const runtime::name_table& names,
              const paint& colours, std::uint64_t marked) const {
    const auto& [each, body] = nodes_[at];
    append_utc_ns(out, each.began_ns);
    out.append(" ").append(2 * std::min(depth, max_depth), ' ').append(each.id == marked ? "> " : "- ");
    out.append(colours.actor()).append(names.name(each.actor)).append(colours.end()).append(" <- ");
    out.append(names.name(each.sender)).append(" ").append(colours.type()).append(names.name(each.type));
    out.append(colours.end()).append(" #").append(std::to_string(each.id)).append(" ");
    out.append(duration_text(each.duration_ns));
    if (each.how != runtime::outcome::handled)
      out.append(" ").append(colours.bad()).append(io::name_of(each.how)).append(colours.end());
    out.append(" ").append(colours.faint());
    append_printable(out, body);
    out.append(body.size() == max_body_bytes ? "..." : "").append(colours.end()).append("\n");
    const auto children = by_cause_.find(each.id);
    const bool was_drawn = each.id == 0 || first_with(each.id) != at; // delivered again: what came of it stands once
    if (children == by_cause_.end() || was_drawn)
      return;
    for (const auto child : children->second)
      append(out, child, depth + 1, names, colours, marked);
  }
  [[nodiscard]] std::size_t first_with(std::uint64_t id) const {
    const auto found = std::ranges::find(nodes_, id, [](const auto& each) { return each.what.id; });
    return static_cast<std::size_t>(found - nodes_.begin());
  }

  std::vector<kept_delivery> nodes_;
  std::map<std::uint64_t, std::vector<std::size_t>> by_cause_;
};

// The run in which the id stands, if there is only one.
tl::expected<std::uint64_t, std::string> run_with(const flow_arguments& given, console& to, cause_index& index) {
  auto trace = open_trace(given.trace, to);
  if (!trace)
    return tl::unexpected(trace.error());
  std::map<std::uint64_t, std::uint64_t> found; // first delivery by run
  delivery each;
  while ((*trace)->reader.next(each)) {
    if (each.id == given.id)
      found.emplace(each.run, each.id);
    index.add(each.id, each.cause);
  }
  if (found.empty())
    return tl::unexpected("no message has the id " + std::to_string(given.id) + " in what could be read");
  if (found.size() > 1)
    return tl::unexpected("several runs have a message with the id " + std::to_string(given.id) +
                          "; choose one with --run");
  index.sort();
  return found.begin()->first;
}

exit_code run_flow(const flow_arguments& given, console& to) {
  cause_index index;
  const auto run = run_with(given, to, index);
  if (!run) {
    to.say(run.error());
    return exit_code::failed;
  }
  const auto family = index.family_of(given.id, given.limit);
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  flow_tree tree;
  auto& out = to.out.text();
  delivery each;
  while ((*trace)->ordered.next(each)) {
    if (each.run != *run || !family.ids.contains(each.id))
      continue;
    tree.add(each);
    if (given.trace.json) {
      append_json_line(out, each, (*trace)->names);
      out += '\n';
    }
  }
  if (!given.trace.json)
    tree.append_to(out, (*trace)->names, paint(to.is_terminal), given.id);
  report_losses((*trace)->reader, to);
  if (!family.is_all)
    to.say("there are more than " + std::to_string(given.limit) + " messages in this flow; --limit shows more of them");
  return exit_code::ok;
}

} // namespace

command add_flow_command(CLI::App& to) {
  auto* const app = to.add_subcommand("flow", "Draws what led to a message and what came of it.");
  const auto given = std::make_shared<flow_arguments>();
  app->add_option("ID", given->id, "Its id, as `log` prints it")->required();
  add_trace_arguments(*app, given->trace);
  constexpr std::size_t most = 100'000;
  app->add_option("--limit", given->limit, "At most so many messages")
      ->check(CLI::Range(std::size_t{1}, most))
      ->capture_default_str();
  app->footer(
      R"(The message itself is marked with >. Each line is a delivery; what stands below and to the right came of it.

Examples:
  godwit-trace flow 13194139533338 trace --run 1
  godwit-trace flow 13194139533338 trace --json | jq -r .type)");
  return {app, [given](console& into) { return run_flow(*given, into); }, always};
}

} // namespace godwit::trace_tool
