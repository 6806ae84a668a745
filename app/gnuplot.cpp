#include "app/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

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
      "# gnuplot {0}.gp\n{1}\nset terminal pngcairo size 1280,800 font 'DejaVu Sans,14'\nset output '{0}.png'\n{2}\n"
      "set terminal svg size 1280,800 font 'DejaVu Sans,19' background 'white'\nset output '{0}.svg'\nreplot\n"
      "unset output\n",
      name, kStyle, plot);
}

/// Exit code of `gnuplot file`, started in `folder`.
int run_gnuplot(const fs::path& folder, std::string file) {
  std::string program = "gnuplot";
  std::array<char*, 3> arguments{program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int problem = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem == ENOENT) throw Error("gnuplot", "is not installed, and draws the figures; install gnuplot-nox");
  if (problem != 0) throw Error("gnuplot", std::strerror(problem));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error("gnuplot", std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void draw(const fs::path& folder, const std::string& name, const std::string& plot) {
  const fs::path file = folder / (name + ".gp");
  write_text(file, script(name, plot));
  if (run_gnuplot(folder, file.filename().string()) == 0) return;
  std::error_code absent;
  for (const char* kind : {".png", ".svg"}) fs::remove(folder / (name + kind), absent);
  throw Error(file.string(), "gnuplot failed on it, and said why above");
}

}  // namespace fathom
