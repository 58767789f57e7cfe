// bench_eyes: the figures of the detector, as docs/performance.md has them. `./dev bench eyes`.
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "tests/bench/eyes/clip.hpp"
#include "tests/bench/eyes/measure.hpp"
#include "tests/bench/eyes/process.hpp"
#include "tests/bench/eyes/recordings.hpp"

namespace {

using namespace godwit::eyes::test;
using godwit::sim::camera::tier;

struct options {
  bool is_tuning = false;
  int seeds = 20;
  int frames = 90;
  int width = 1280;
  std::string folder;
  std::string recordings;
  std::string model;
  std::vector<std::string> tiers{"a", "b"};
  clip_options clip;
  process_options process;
  std::vector<std::string> parts{"scores", "quiet", "pan", "places"};
};

std::uint64_t seed_of(const options& chosen, int n) {
  const auto at = static_cast<std::uint64_t>(n);
  return chosen.is_tuning ? godwit::sim::camera::tuning_seed(at) : godwit::sim::camera::held_back_seed(at);
}

const char* name_of_tier(tier which) { return which == tier::a ? "A" : "B"; }

measure_options scene_of(const options& chosen) {
  measure_options made;
  made.scene.width = chosen.width;
  made.scene.height = chosen.width * 9 / 16;
  made.frames = chosen.frames;
  made.folder = chosen.folder;
  return made;
}

void print_reasons(const measured& sum) {
  std::printf("| pictures by reason |");
  for (const auto& [name, count] : sum.reasons)
    std::printf(" %s %d", name.c_str(), count);
  std::printf(" |\n");
}

void print_scores(const options& chosen, tier which) {
  measured sum;
  for (int n = 0; n < chosen.seeds; ++n)
    measure(seed_of(chosen, n), which, scene_of(chosen), sum);
  std::printf("\n| tier %s, %d seeds, %d pictures of %d x %d | |\n|---|---|\n", name_of_tier(which), chosen.seeds,
              sum.frames, chosen.width, chosen.width * 9 / 16);
  const auto line = [](const char* name, const score& half, const score& quarter) {
    std::printf("| %s: F1 at 0.5 / 0.25; precision, recall at 0.25 | %.3f / %.3f; %.2f, %.2f |\n", name, half.f1(),
                quarter.f1(), quarter.precision(), quarter.recall());
  };
  line("detector", sum.at_half, sum.at_quarter);
  line("naive, tuned", sum.tuned_half, sum.tuned_quarter);
  line("naive, as first written", sum.naive_half, sum.naive_quarter);
  std::printf("| processor time a picture, p50 / p99; naive p50 | %.1f / %.1f ms; %.1f ms |\n",
              quantile(sum.milliseconds, 0.5), quantile(sum.milliseconds, 0.99), quantile(sum.naive_milliseconds, 0.5));
  std::printf("| corner error of the homography, median / p99 | %.2f / %.2f px |\n",
              quantile(sum.corner_errors_px, 0.5), quantile(sum.corner_errors_px, 0.99));
  print_reasons(sum);
  std::fflush(stdout);
}

// Without movers, for so many pictures that a minute has a meaning.
void print_quiet(const options& chosen, tier which) {
  measured sum;
  auto scene = scene_of(chosen);
  scene.scene.has_movers = false;
  scene.has_naive = false;
  for (int n = 0; n < chosen.seeds; ++n)
    measure(seed_of(chosen, n), which, scene, sum);
  const double minutes = sum.frames / (30.0 * 60);
  std::printf("\n| tier %s without movers, %d pictures of %d x %d | |\n|---|---|\n", name_of_tier(which), sum.frames,
              chosen.width, chosen.width * 9 / 16);
  std::printf("| false tracks; a minute at 30 a second | %d; %.1f |\n", sum.tracks, sum.tracks / minutes);
  print_reasons(sum);
  std::fflush(stdout);
}

void print_pan(const options& chosen) {
  measured still;
  measured panned;
  auto scene = scene_of(chosen);
  scene.has_naive = false;
  for (int n = 0; n < chosen.seeds; ++n) {
    scene.scene.pan_deg_s = 0;
    measure(seed_of(chosen, n), tier::a, scene, still);
    scene.scene.pan_deg_s = 60;
    measure(seed_of(chosen, n), tier::a, scene, panned);
  }
  std::printf("\n| tier A, pan of 60 degrees a second, pose known, %d pictures | |\n|---|---|\n", panned.frames);
  std::printf("| F1 at 0.5 / 0.25 without the pan | %.3f / %.3f |\n", still.at_half.f1(), still.at_quarter.f1());
  std::printf("| with it | %.3f / %.3f |\n", panned.at_half.f1(), panned.at_quarter.f1());
  print_reasons(panned);
  std::fflush(stdout);
}

void print_places() {
  const auto figures = measure_places(20'000);
  std::printf("\n| place on the ground, 100 m high, 45 degrees off the nadir | |\n|---|---|\n");
  std::printf("| attitude wrong by 1 degree: at most; the geometry alone | %.2f m; %.2f m |\n", figures.at_one_degree_m,
              figures.geometry_m);
  std::printf(
      "| attitude with a deviation of 1 degree in each axis: median; within its own 95 %% | %.2f m; %.1f %% |\n",
      figures.median_m, figures.share_inside * 100);
  std::fflush(stdout);
}

void print_pair(const char* name, const pair_of_scores& of) {
  std::printf("| %s: recall, precision at 0.5; at 0.25 | %.2f, %.2f; %.2f, %.2f (F1 %.3f / %.3f) |\n", name,
              of.half.recall(), of.half.precision(), of.quarter.recall(), of.quarter.precision(), of.half.f1(),
              of.quarter.f1());
}

bool print_clip(const options& chosen) {
  auto wanted = chosen.clip;
  wanted.folder = chosen.folder;
  const auto found = measure_clip(wanted);
  if (!found) {
    std::fprintf(stderr, "bench_eyes: clip: %s\n", found.error().c_str());
    return false;
  }
  const auto& counted = found->detector.half;
  std::printf("\n| %s, %d pictures as 640 x 480, moved by seed %llu, %d of use | |\n|---|---|\n", wanted.clip.c_str(),
              found->frames, static_cast<unsigned long long>(wanted.seed), found->usable);
  std::printf("| labelled by hand | %d pictures, %d people that count |\n", found->labelled,
              counted.found + counted.missed);
  print_pair("detector, moved camera", found->detector);
  print_pair("naive, tuned, moved camera", found->naive);
  print_pair("MOG2, the clip itself", found->still);
  std::printf("| the other pictures, against MOG2 on the clip itself | %d |\n", found->rest_frames);
  print_pair("detector, moved camera", found->rest);
  std::printf("| corner error of the homography, median / p99; fastest corner | %.2f / %.2f px; %.1f px a picture |\n",
              quantile(found->corner_errors_px, 0.5), quantile(found->corner_errors_px, 0.99), found->fastest_px);
  std::printf("| processor time a picture, p50 / p99 | %.1f / %.1f ms |\n", quantile(found->milliseconds, 0.5),
              quantile(found->milliseconds, 0.99));
  return true;
}

bool measure_and_print_recordings(const options& chosen) {
  const auto found = measure_recordings(chosen.recordings, chosen.folder, chosen.model);
  if (!found) {
    std::fprintf(stderr, "bench_eyes: %s\n", found.error().c_str());
    return false;
  }
  print_recordings(*found);
  return true;
}

bool print_process(const options& chosen) {
  const auto found = measure_process(chosen.process);
  if (!found) {
    std::fprintf(stderr, "bench_eyes: process: %s\n", found.error().c_str());
    return false;
  }
  std::printf("\n| godwit-eyes, a recording of 1280 x 720 at 30 a second, %.0f s%s | |\n|---|---|\n", found->seconds,
              chosen.process.has_recording ? ", and it records" : "");
  std::printf("| pictures; dropped; that said something; shown | %llu; %llu; %llu; %llu |\n",
              static_cast<unsigned long long>(found->frames), static_cast<unsigned long long>(found->dropped),
              static_cast<unsigned long long>(found->usable), static_cast<unsigned long long>(found->pictures));
  std::printf("| capture to candidate, p50 / p99 / most of %zu | %.1f / %.1f / %.1f ms |\n", found->latencies_ms.size(),
              quantile(found->latencies_ms, 0.5), quantile(found->latencies_ms, 0.99),
              quantile(found->latencies_ms, 1));
  std::printf("| processor, decoding too | %.1f %% of a core |\n", found->share * 100);
  std::printf("| resident; at most | %.0f MB; %.0f MB |\n", found->resident_mb, found->most_resident_mb);
  return true;
}

void add_options(CLI::App& app, options& chosen) {
  app.add_flag("--tuning", chosen.is_tuning, "seeds for tuning; else those that are held back");
  app.add_option("--seeds", chosen.seeds, "flights for each table")->check(CLI::Range(1, 1000));
  app.add_option("--frames", chosen.frames, "pictures of each flight")->check(CLI::Range(31, 1800));
  app.add_option("--width", chosen.width, "of the pictures; they are 16:9")->check(CLI::Range(320, 1920));
  app.add_option("--draw", chosen.folder, "draws what was seen into this folder, one picture of fifteen");
  app.add_option("--tier", chosen.tiers, "a: planes; b: what stands on them, too; both if not said")
      ->check(CLI::IsMember({"a", "b"}));
  app.add_option("--clips", chosen.recordings,
                 "a folder of recordings with labels (docs/godwit-eyes.md): scores these, and nothing else");
  app.add_option("--model", chosen.model, "with --clips: a net, as camera.model");
  app.add_option("--clip", chosen.clip.clip, "clip: vtest.avi of the package opencv-doc");
  app.add_option("--labels", chosen.clip.labels, "clip: who is in it");
  app.add_option("--motion", chosen.clip.seed, "clip: the seed of the camera's motion");
  app.add_option("--eyes", chosen.process.program, "process: the program");
  app.add_option("--seconds", chosen.process.seconds, "process: of the flight")->check(CLI::Range(10, 60));
  app.add_flag("--record", chosen.process.has_recording, "process: it records, too");
  app.add_option("parts", chosen.parts,
                 "what to measure: scores, quiet, pan, places (these if not said), clip, process")
      ->check(CLI::IsMember({"scores", "quiet", "pan", "places", "clip", "process"}));
}

} // namespace

int main(int argc, char** argv) {
  options chosen;
  CLI::App app{"Measures the detector of godwit-eyes on generated scenes.", "bench_eyes"};
  chosen.clip.labels = GODWIT_TEST_DATA "/eyes/vtest_labels.json";
  chosen.process.program = GODWIT_EYES_PROGRAM;
  add_options(app, chosen);
  CLI11_PARSE(app, argc, argv);
  godwit::eyes::use_one_thread();
  godwit::eyes::keep_freed_memory(); // as the program does
  if (!chosen.recordings.empty())
    return measure_and_print_recordings(chosen) ? 0 : 1;
  std::printf("seeds: %s\n", chosen.is_tuning ? "for tuning" : "held back");
  bool is_well = true;
  for (const auto& part : chosen.parts) {
    if (part == "pan")
      print_pan(chosen);
    if (part == "places")
      print_places();
    if (part == "clip")
      is_well = print_clip(chosen) && is_well;
    if (part == "process")
      is_well = print_process(chosen) && is_well;
    for (const auto& name : chosen.tiers)
      if (part == "scores")
        print_scores(chosen, name == "a" ? tier::a : tier::b);
      else if (part == "quiet")
        print_quiet(chosen, name == "a" ? tier::a : tier::b);
  }
  return is_well ? 0 : 1;
}
