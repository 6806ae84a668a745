#include "app/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// Colours: Okabe & Ito's, which colour-blind readers can tell apart.
constexpr const char* kStyle = R"(set encoding utf8
set datafile separator ','
set datafile columnheaders
blue = 0x0072B2; orange = 0xE69F00; red = 0xD55E00; green = 0x009E73; sky = 0x56B4E9; ink = 0x333333; pale = 0xB8B8B8
set border 3 lc rgb ink lw 1.2
set tics nomirror textcolor rgb ink
set grid lc rgb 0xE4E4E4 lt 1 lw 1
set key textcolor rgb ink spacing 1.25 samplen 2.5
set title font ',17' textcolor rgb ink offset 0,0.3
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
)";

std::string script(const std::string& name, const std::string& plot) {
  return fmt::format(
      "# gnuplot {0}.gp\n{1}\nif (!exists('png_file')) png_file = '{0}.png'\n"
      "if (!exists('svg_file')) svg_file = '{0}.svg'\n"
      "set terminal pngcairo size 1280,800 font 'DejaVu Sans,14'\nset output png_file\n{2}\n"
      "set terminal svg size 1280,800 font 'DejaVu Sans,19' background 'white'\nset output svg_file\nreplot\n"
      "unset output\n",
      name, kStyle, plot);
}

/// Exit code of `gnuplot -d …`, without the user's own settings, started in `folder`.
int run_gnuplot(const fs::path& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"gnuplot", "-d"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int problem = posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem == ENOENT) throw Error("gnuplot", "is not installed, and draws the figures; install gnuplot-nox");
  if (problem != 0) throw Error("gnuplot", std::strerror(problem));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error("gnuplot", std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void require_gnuplot() {
  if (run_gnuplot(".", {"-e", "exit"}) != 0) throw Error("gnuplot", "does not run, and draws the figures");
}

void draw(const fs::path& folder, const std::string& name, const std::string& plot) {
  const fs::path file = folder / (name + ".gp");
  write_text(file, script(name, plot));
  write_atomically(folder / (name + ".png"), [&](const fs::path& png) {
    write_atomically(folder / (name + ".svg"), [&](const fs::path& svg) {
      const std::string names =
          fmt::format("png_file = '{}'; svg_file = '{}'", png.filename().string(), svg.filename().string());
      if (run_gnuplot(folder, {"-e", names, file.filename().string()}) != 0)
        throw Error(file.string(), "gnuplot failed on it, and said why above");
    });
  });
}

}  // namespace fathom
