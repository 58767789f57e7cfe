#include "programs/godwit-drill/flights/flight_drill.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <utility>

#include <unistd.h>

#include "io/text.hpp"
#include "programs/common/command.hpp"
#include "programs/godwit-drill/flights/case_runner.hpp"
#include "programs/godwit-drill/flights/cut_flight.hpp"
#include "programs/godwit-drill/flights/drill_book.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "programs/godwit-drill/flights/intervention_flight.hpp"
#include "programs/godwit-drill/flights/random_flight.hpp"
#include "programs/godwit-drill/progress_bar.hpp"

namespace godwit::drill {

namespace {

using programs::exit_code;

constexpr std::array all_vehicles{sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                  sim::personality::plane};
constexpr std::size_t most_explained = 5; // failing flights of one run that are flown again, for their trace
constexpr std::size_t most_stories = 10;  // of one run; a failing flight after these is named without its story

std::vector<sim::personality> vehicles_of(const flight_drill_options& options) {
  if (options.who)
    return {*options.who};
  return {all_vehicles.begin(), all_vehicles.end()};
}

// By vehicle.
struct undisturbed_flights {
  std::vector<std::uint64_t> commits;
  std::vector<double> flown_s;
};

// Flown by workers, as all flights are: nothing of a flight is left here.
undisturbed_flights fly_each_undisturbed(vehicles which, unsigned jobs) {
  undisturbed_flights result{std::vector<std::uint64_t>(which.size()), std::vector<double>(which.size())};
  run_cases(
      which.size(), {.jobs = jobs}, [&](std::size_t i) { return fly_undisturbed(which[i], {}); },
      [&](std::size_t i, const flight_outcome& outcome) {
        result.commits[i] = outcome.commits;
        result.flown_s[i] = outcome.flown_s;
      });
  return result;
}

std::vector<flight_case> joined(std::vector<flight_case> some, std::vector<flight_case> others) {
  some.insert(some.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  return some;
}

std::vector<flight_case> cases_by_commit(flight_drill drill, vehicles which, unsigned jobs) {
  const auto flown = fly_each_undisturbed(which, jobs);
  if (drill == flight_drill::disk)
    return joined(disk_cases(which, flown.commits), stored_disk_cases(which, flown.commits));
  return joined(process_cases(which, flown.commits), kill_cases(which, flown.flown_s));
}

std::vector<flight_case> cases_of(const flight_drill_options& options) {
  const auto which = vehicles_of(options);
  switch (options.which) {
  case flight_drill::simulate:
  case flight_drill::interventions:
  case flight_drill::starts:
    return {};
  case flight_drill::actors:
    return joined(joined(actor_cases(which), actor_loss_cases(which)), scan_cases(which));
  case flight_drill::process:
  case flight_drill::disk:
    return cases_by_commit(options.which, which, options.jobs);
  case flight_drill::links:
    return link_cases(which);
  case flight_drill::people:
    return joined(people_cases(which), takeover_cases(which));
  case flight_drill::clock:
    return clock_cases(which);
  }
  return {};
}

// The options that change what a flight of this name is.
std::string words_of(const flight_drill_options& options) {
  std::string result = "godwit-drill " + std::string(io::name_of(options.which));
  if (options.who && is_by_seed(options.which))
    result += " --personality " + std::string(io::name_of(*options.who));
  if (options.stream_hz)
    result += " --stream-hz " + std::to_string(*options.stream_hz);
  if (options.planted != planted_flaw::none)
    result += " --plant " + std::string(io::name_of(options.planted));
  return result;
}

flight_outcome fly_seed(const flight_drill_options& options, std::uint64_t seed, const flight_wishes& wishes,
                        const std::vector<std::uint64_t>& without) {
  const auto fly = options.which == flight_drill::simulate ? fly_random
                   : options.which == flight_drill::starts ? fly_cut
                                                           : fly_intervention;
  return fly(seed, options.who, wishes, without);
}

std::uint64_t most_faults_of(flight_drill which) {
  return which == flight_drill::simulate        ? most_faults
         : which == flight_drill::interventions ? most_interventions + 1
         : which == flight_drill::starts        ? most_cuts + 1
                                                : 0;
}

// The flights of a run by their index: where they come from, and how each is flown again.
class flight_list {
public:
  explicit flight_list(const flight_drill_options& options) : options_(options), cases_(cases_of(options)) {
    if (!options.only.empty())
      std::erase_if(cases_, [&](const flight_case& each) { return each.name != options.only; });
    if (options.sample && *options.sample < cases_.size()) {
      std::mt19937_64 drawn(options.sample_seed);
      std::ranges::shuffle(cases_, drawn);
      cases_.resize(*options.sample);
    }
  }

  [[nodiscard]] std::size_t size() const {
    return is_by_seed() ? options_.seeds.last - options_.seeds.first + 1 : cases_.size();
  }
  [[nodiscard]] std::string name(std::size_t index) const {
    return is_by_seed() ? "seed " + std::to_string(options_.seeds.first + index) : cases_[index].name;
  }
  [[nodiscard]] std::string group(std::size_t index) const {
    return is_by_seed() ? "process gone" : cases_[index].group;
  }
  [[nodiscard]] std::string again(std::size_t index) const {
    if (!is_by_seed())
      return words_of(options_) + " --only " + cases_[index].name;
    auto result = words_of(options_) + " --seeds " + std::to_string(options_.seeds.first + index);
    for (const auto fault : options_.without)
      result += " --without " + std::to_string(fault);
    return result;
  }
  [[nodiscard]] flight_outcome fly(std::size_t index) const {
    const flight_wishes wishes{options_.planted, size() == 1, options_.stream_hz,
                               size() == 1 ? options_.trace_folder : std::string()};
    return is_by_seed() ? fly_seed(options_, options_.seeds.first + index, wishes, options_.without)
                        : cases_[index].fly(wishes);
  }

private:
  [[nodiscard]] bool is_by_seed() const { return drill::is_by_seed(options_.which); }

  const flight_drill_options& options_;
  std::vector<flight_case> cases_;
};

double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// False, with a word about it: it can not be written. An empty FILE is not asked for.
bool write_file(const std::string& file, const std::string& text) {
  if (file.empty())
    return true;
  std::ofstream out(file);
  out << text;
  if (out.flush())
    return true;
  std::fprintf(stderr, "godwit-drill: %s can not be written\n", file.c_str());
  return false;
}

bool write_files(const drill_book& book, const flight_drill_options& options, double took_s) {
  auto document = book.to_json(took_s);
  document["drill"] = io::name_of(options.which);
  document["jobs"] = options.jobs;
  const bool is_json_written = write_file(options.json_file, document.dump(2) + '\n');
  return write_file(options.html_file, to_html({words_of(options), took_s, book})) && is_json_written;
}

// What else has to be left out of a random flight, so that it still fails with all that is left.
std::vector<std::uint64_t> not_needed(const flight_drill_options& one, std::uint64_t faults) {
  const auto fails = [&](const std::vector<std::uint64_t>& without) {
    bool is_failing = false;
    run_cases(
        1, {},
        [&](std::size_t) {
          return fly_seed(one, one.seeds.first, {one.planted, false, one.stream_hz, {}}, without);
        },
        [&](std::size_t, const flight_outcome& outcome) { is_failing = !outcome.held(); });
    return is_failing;
  };
  return not_needed_to_fail(faults, fails);
}

std::filesystem::path folder_for_traces(const flight_drill_options& options) {
  if (!options.trace_folder.empty())
    return options.trace_folder;
  return std::filesystem::temp_directory_path() / ("godwit-drill-" + std::to_string(::getpid()));
}

std::string as_file_name(std::string name) {
  std::ranges::replace_if(
      name, [](char each) { return each == '/' || each == ' '; }, '_');
  return name;
}

// Flies failing flights again, each in a worker: random ones with fewer and fewer faults, and then each once more with
// the trace of its actors.
void explain(const flight_drill_options& options, const std::vector<flight_outcome>& failing) {
  for (const auto& each : failing) {
    auto one = options;
    one.sample.reset();
    one.trace_folder = (folder_for_traces(options) / as_file_name(each.name)).string();
    if (is_by_seed(options.which)) {
      one.seeds.first = one.seeds.last = std::stoull(each.name.substr(std::string_view("seed ").size()));
      one.without = not_needed(one, each.faults);
    } else {
      one.only = each.name;
    }
    const flight_list list(one);
    if (is_by_seed(options.which))
      std::printf("%s fails with %llu of %llu faults: %s\n", each.name.c_str(),
                  static_cast<unsigned long long>(each.faults - one.without.size()),
                  static_cast<unsigned long long>(each.faults), list.again(0).c_str());
    run_cases(
        1, {}, [&](std::size_t index) { return list.fly(index); }, [](std::size_t, const flight_outcome&) {});
    std::printf("%s has left its trace: godwit-trace log %s\n", each.name.c_str(), one.trace_folder.c_str());
  }
}

int say_end(const drill_book& book, const flight_list& flights, const flight_drill_options& options, double took_s) {
  std::printf("\n%s", book.to_table(took_s).c_str());
  if (!write_files(book, options, took_s))
    return static_cast<int>(exit_code::failed);
  const auto failed = book.total().failed;
  if (failed > 0) {
    std::printf("FAILED: %llu of %zu flights\n", static_cast<unsigned long long>(failed), flights.size());
    return static_cast<int>(exit_code::failed);
  }
  if (book.total().known > 0)
    std::printf("passed, but for the known findings of %llu flights (docs/roadmap.md)\n",
                static_cast<unsigned long long>(book.total().known));
  else
    std::printf("passed: nothing lost, nothing doubled, no promise broken\n");
  return static_cast<int>(exit_code::ok);
}

} // namespace

std::optional<seed_range> seed_range_from(const std::string& text) {
  const auto dots = text.find("..");
  seed_range result;
  const std::string_view whole = text;
  if (!io::read_number(whole.substr(0, dots), result.first))
    return std::nullopt;
  result.last = result.first;
  if (dots != std::string::npos && !io::read_number(whole.substr(dots + 2), result.last))
    return std::nullopt;
  if (result.last < result.first || result.last - result.first == UINT64_MAX)
    return std::nullopt;
  return result;
}

std::optional<shard> shard_from(const std::string& text) {
  const auto slash = text.find('/');
  shard result;
  const std::string_view whole = text;
  if (slash == std::string::npos || !io::read_number(whole.substr(0, slash), result.number) ||
      !io::read_number(whole.substr(slash + 1), result.of) || result.number < 1 || result.number > result.of)
    return std::nullopt;
  return result;
}

std::optional<seed_range> part_of(const seed_range& all, const shard& which) {
  const auto seeds = all.last - all.first + 1;
  const auto each = seeds / which.of;
  const auto longer = seeds % which.of; // so many parts have one more
  const auto before = which.number - 1;
  const auto length = each + (before < longer ? 1 : 0);
  if (length == 0)
    return std::nullopt;
  const auto first = all.first + before * each + std::min(before, longer);
  return seed_range{first, first + length - 1};
}

int run_flight_drill(const flight_drill_options& wanted) {
  const auto part = part_of(wanted.seeds, wanted.shard);
  if (!part) {
    std::printf("there are fewer seeds than parts: none is left for this one\n");
    return static_cast<int>(exit_code::ok);
  }
  auto options = wanted;
  options.seeds = *part;
  const flight_list flights(options);
  if (flights.size() == 0) {
    std::fprintf(stderr, "godwit-drill: there is no flight %s in this drill\n", options.only.c_str());
    return static_cast<int>(exit_code::usage);
  }
  std::printf("%s: %zu flights, %u at a time\n", words_of(options).c_str(), flights.size(), options.jobs);
  if (options.sample)
    std::printf("drawn with --sample %llu --sample-seed %llu\n", static_cast<unsigned long long>(*options.sample),
                static_cast<unsigned long long>(options.sample_seed));
  std::fflush(stdout);
  drill_book book(!is_by_seed(options.which));
  progress_bar bar(flights.size());
  std::vector<flight_outcome> to_explain;
  const auto began = std::chrono::steady_clock::now();
  run_cases(
      flights.size(), {.jobs = options.jobs}, [&](std::size_t index) { return flights.fly(index); },
      [&](std::size_t index, flight_outcome outcome) {
        if (outcome.name.empty()) { // its process is gone
          outcome.name = flights.name(index);
          outcome.group = flights.group(index);
          outcome.faults = most_faults_of(options.which);
        }
        if (!outcome.held())
          outcome.again = flights.again(index);
        book.take(outcome);
        const auto failed = book.total().failed;
        const bool is_explained = is_by_seed(options.which) ? options.without.empty() : flights.size() > 1;
        if (!outcome.held() && is_explained && to_explain.size() < most_explained)
          to_explain.push_back(outcome);
        if (!outcome.held()) {
          if (failed > most_stories)
            outcome.story.clear();
          std::printf("%s", text_of_failure(outcome).c_str());
          std::fflush(stdout);
        } else if (flights.size() == 1) {
          std::printf("%s", outcome.story.c_str());
        }
        bar.show(book.total().flights, std::to_string(failed) + " failed");
      });
  bar.finish();
  const auto took_s = seconds_since(began);
  explain(options, to_explain);
  return say_end(book, flights, options, took_s);
}

std::vector<std::uint64_t>
not_needed_to_fail(std::uint64_t faults, const std::function<bool(const std::vector<std::uint64_t>& without)>& fails) {
  std::vector<std::uint64_t> result;
  for (bool is_shorter = true; is_shorter;) { // what was needed beside another fault may not be without it
    is_shorter = false;
    for (std::uint64_t fault = 0; fault < faults; ++fault) {
      if (std::ranges::find(result, fault) != result.end())
        continue;
      auto without = result;
      without.push_back(fault);
      std::ranges::sort(without);
      if (!fails(without))
        continue;
      result = std::move(without);
      is_shorter = true;
    }
  }
  return result;
}

} // namespace godwit::drill
