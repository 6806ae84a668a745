// Random scenes, one after the other, each held to the laws of captures and of light.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "tests/soak/capture_laws.h"
#include "tests/soak/light_laws.h"
#include "tests/soak/random_scene.h"

namespace fathom {
namespace {

constexpr const char* kUsage =
    "usage: soak [--scenes N] [--seed S] [--first N] [-o DIR]\n"
    "Captures N (100) random scenes, from number N (0) on, and checks that nothing crashes, that every pixel\n"
    "is finite and that light is not made. A scene that fails stays in DIR (soak), and the command that shoots\n"
    "it again is printed; the one under way when the program dies stays there, too.\n";

struct Options {
  std::uint64_t scenes = 100, seed = 1, first = 0;
  std::filesystem::path output = "soak";
};

/// Nothing where the arguments are no use.
std::optional<Options> options_from(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    const char *value = argv[i + 1], *end = value + std::strlen(value);
    std::uint64_t* number = name == "--scenes"  ? &options.scenes
                            : name == "--seed"  ? &options.seed
                            : name == "--first" ? &options.first
                                                : nullptr;
    if (name == "-o")
      options.output = value;
    else if (!number || std::from_chars(value, end, *number).ptr != end)
      return std::nullopt;
  }
  return options;
}

struct Outcome {
  std::string command;              ///< that shoots the scene again
  std::vector<std::string> broken;  ///< laws
  std::string refused;              ///< why, if it was
};

std::string capture_command(const std::filesystem::path& folder, const RandomShot& shot, std::uint64_t seed) {
  return fmt::format("fathom capture {} --mode {} --light {} --spp 1 --seed {} -o {}", (folder / "scene.json").string(),
                     shot.mode == CaptureMode::geometric ? "geometric" : "photometric",
                     shot.light == LightModel::full ? "full" : "direct", seed, (folder / "out").string());
}

Outcome shoot(std::uint64_t seed, std::uint64_t number, const std::filesystem::path& folder, TubeCounts& counts) {
  Outcome outcome;
  try {
    const RandomShot shot = write_random_scene(seed, number, folder);
    outcome.command = capture_command(folder, shot, seed);
    const Setup setup = read_setup(folder / "scene.json");
    Camera camera(setup, shot.mode, 1, seed, shot.light);
    outcome.broken = broken_capture_laws(setup.rig, camera, shot.light, camera.shoot(0));
    // The projector's search of clear bodies takes longer than all else and would be made twice for every scene.
    if (shot.mode == CaptureMode::photometric) return outcome;
    const Intersector world(camera.geometry());
    const PointLight projector(world, setup.rig.projector_in_world());
    for (std::string& law : broken_light_laws(projector, setup.rig, counts)) outcome.broken.push_back(std::move(law));
  } catch (const Error& refusal) {
    outcome.refused = refusal.what();
  } catch (const std::exception& problem) {
    outcome.broken.push_back(fmt::format("ended with: {}", problem.what()));
  }
  return outcome;
}

int soak(const Options& options) {
  // Scenes are drawn so that few do not fit together; were they many, little would be tested. So with tubes at edges.
  constexpr double kMostRefused = 0.05, kMostTorn = 0.01;
  std::uint64_t failed = 0, refused = 0, slowest = 0;
  double most_seconds = 0.0;
  std::string last_refusal;
  TubeCounts counts;
  {
    Progress progress("scene", options.scenes, false);
    for (std::uint64_t number = options.first; number < options.first + options.scenes; ++number) {
      const auto start = std::chrono::steady_clock::now();
      const std::filesystem::path folder = options.output / fmt::format("{}_{}", options.seed, number);
      make_directory(folder);
      const Outcome outcome = shoot(options.seed, number, folder, counts);
      if (!outcome.refused.empty()) ++refused, last_refusal = outcome.refused;
      if (outcome.broken.empty()) {
        std::filesystem::remove_all(folder);
      } else {
        ++failed;
        fmt::print("seed {} scene {}: {}\n", options.seed, number, outcome.command);
        constexpr std::size_t kShown = 5;
        for (std::size_t i = 0; i < std::min(outcome.broken.size(), kShown); ++i)
          fmt::print("  {}\n", outcome.broken[i]);
        if (outcome.broken.size() > kShown) fmt::print("  and {} more\n", outcome.broken.size() - kShown);
        std::fflush(stdout);
      }
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (seconds > most_seconds) most_seconds = seconds, slowest = number;
      progress.step();
    }
  }
  const double scenes = static_cast<double>(options.scenes);
  const double tubes = static_cast<double>(counts.held + counts.torn);
  fmt::print("{} scenes: {} failed, {} refused; {} tubes of light, {} at edges; slowest {:.2g} s (scene {})\n",
             options.scenes, failed, refused, counts.held + counts.torn, counts.torn, most_seconds, slowest);
  if (refused > 0) fmt::print("last refusal: {}\n", last_refusal);
  const bool idle =
      static_cast<double>(refused) > kMostRefused * scenes || static_cast<double>(counts.torn) > kMostTorn * tubes;
  if (idle) fmt::print("too many refused or at edges\n");
  return failed > 0 || idle ? 1 : 0;
}

}  // namespace
}  // namespace fathom

int main(int argc, char** argv) {
  const auto options = fathom::options_from(argc, argv);
  if (options) return fathom::soak(*options);
  fmt::print(stderr, "{}", fathom::kUsage);
  return 2;
}
