// Source: "Trace Event Format", Google, 2016; flow events "s" and "f" bind to the slice around their time.
#include <array>
#include <cstdio>
#include <set>
#include <unordered_map>

#include "io/fields/json_text.hpp"
#include "io/time_units.hpp"
#include "programs/godwit-trace/actors/exporting/export_format.hpp"

namespace godwit::trace_tool {

namespace {

// Microseconds with nanoseconds behind the point, as the format wants them. A double of so large a number is not exact.
std::string microseconds(std::int64_t ns) {
  std::array<char, 64> text{};
  const int size =
      std::snprintf(text.data(), text.size(), "%lld.%03lld", static_cast<long long>(ns / ns_per_us), // NOLINT(*-vararg)
                    static_cast<long long>(ns % ns_per_us));
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

// One process for each run, one thread for each actor. A delivery is a slice, and where its cause is shown too, an
// arrow from there.
class perfetto final : public exporter {
public:
  perfetto(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit) {}

  void begin(std::string& out) override { out += R"({"displayTimeUnit":"ns","traceEvents":[)"; }
  void take(std::string& out, const runtime::delivery& each) override {
    if (!has_room(limit_))
      return;
    if (each.run != run_ || begin_ns_ == 0) {
      run_ = each.run;
      shown_.clear();
      begin_ns_ = begin_ns_ == 0 ? each.began_ns : begin_ns_;
      named_.clear();
      name(out, "process_name", 0, "godwitd, run " + std::to_string(run_));
    }
    if (named_.insert(each.actor).second)
      name(out, "thread_name", each.actor + 1, names_.name(each.actor));
    append_slice(out, each);
    append_arrow(out, each);
  }
  void end(std::string& out) override { out += "\n]}\n"; }

private:
  void event(std::string& out, const char* phase, std::uint32_t thread) {
    out += is_first_ ? "\n" : ",\n";
    is_first_ = false;
    out.append(R"({"ph":")").append(phase).append(R"(","pid":)").append(std::to_string(run_));
    out.append(R"(,"tid":)").append(std::to_string(thread));
  }
  void name(std::string& out, const char* what, std::uint32_t thread, const std::string& value) {
    event(out, "M", thread);
    out.append(R"(,"name":")").append(what).append(R"(","args":{"name":)");
    io::append_json_string(out, value);
    out += "}}";
  }
  void append_slice(std::string& out, const runtime::delivery& each) {
    event(out, "X", each.actor + 1);
    out.append(R"(,"ts":)").append(microseconds(each.began_ns - begin_ns_));
    out.append(R"(,"dur":)").append(microseconds(each.duration_ns)).append(R"(,"name":)");
    io::append_json_string(out, names_.name(each.type));
    out.append(R"(,"cat":")")
        .append(io::name_of(each.how))
        .append(R"(","args":{"id":)")
        .append(std::to_string(each.id));
    out.append(R"(,"cause":)").append(std::to_string(each.cause)).append(R"(,"sender":)");
    io::append_json_string(out, names_.name(each.sender));
    out.append(R"(,"incarnation":)").append(std::to_string(each.incarnation));
    out.append(R"(,"unix_ns":)").append(std::to_string(each.began_ns));
    if (!each.body.empty())
      out.append(R"(,"message":)").append(each.body);
    out += "}}";
  }
  void append_arrow(std::string& out, const runtime::delivery& each) {
    const auto cause = shown_.find(each.cause);
    if (each.cause != 0 && cause != shown_.end() && each.sender != each.actor) {
      const auto number = std::to_string(++arrows_);
      event(out, "s", cause->second.actor + 1);
      out.append(R"(,"cat":"cause","name":"cause","id":)").append(number);
      out.append(R"(,"ts":)").append(microseconds(cause->second.began_ns - begin_ns_)).append("}");
      event(out, "f", each.actor + 1);
      out.append(R"(,"cat":"cause","name":"cause","bp":"e","id":)").append(number);
      out.append(R"(,"ts":)").append(microseconds(each.began_ns - begin_ns_)).append("}");
    }
    if (each.id != 0)
      shown_[each.id] = {each.actor, each.began_ns};
  }

  struct place {
    std::uint32_t actor = 0;
    std::int64_t began_ns = 0;
  };
  const runtime::name_table& names_;
  std::uint64_t limit_;
  bool is_first_ = true;
  std::uint64_t run_ = 0;
  std::int64_t begin_ns_ = 0; // of the first delivery: readers want small numbers
  std::uint64_t arrows_ = 0;
  std::set<std::uint32_t> named_;
  std::unordered_map<std::uint64_t, place> shown_; // by id; as many as the limit lets through
};

} // namespace

std::unique_ptr<exporter> make_perfetto(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<perfetto>(names, limit);
}

} // namespace godwit::trace_tool
