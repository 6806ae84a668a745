#include "app/gnuplot.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "app/gnuplot_text.h"
#include "app/whole_picture.h"
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

/// The first line of NAME.gp, by which a script of ours is known.
std::string head_of(const std::string& name) { return fmt::format("# gnuplot {}.gp\n", name); }

std::string script(const std::string& name, const std::string& plot, const std::string& before_svg) {
  return fmt::format(
      "{}{}\nif (!exists('png_file')) png_file = {}\nif (!exists('svg_file')) svg_file = {}\n"
      "set terminal pngcairo size 1280,800 font 'DejaVu Sans,14'\nset output png_file\n{}\n"
      "set terminal svg size 1280,800 font 'DejaVu Sans,19' background 'white'\nset output svg_file\n{}replot\n"
      "unset output\n",
      head_of(name), kStyle, gnuplot_text(name + ".png"), gnuplot_text(name + ".svg"), plot, before_svg);
}

constexpr int kNotInstalled = 127;  // as shells say it

/// Exit code of `gnuplot -d …`, without the user's own settings, started in `folder`. It ends when this process does,
/// so that nobody writes into the folder of a run that was killed.
int run_gnuplot(const fs::path& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"gnuplot", "-d"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw Error("gnuplot", std::strerror(errno));
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent && ::chdir(folder.c_str()) == 0) ::execvp(arguments.front(), arguments.data());
    ::_exit(kNotInstalled);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error("gnuplot", std::strerror(errno));
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == kNotInstalled) throw Error("gnuplot", "is not installed, and draws the figures; install gnuplot-nox");
  return code;
}

}  // namespace

void require_gnuplot() {
  if (run_gnuplot(".", {"-e", "exit"}) != 0) throw Error("gnuplot", "does not run, and draws the figures");
}

void draw(const fs::path& folder, const std::string& name, const std::string& plot, const std::string& before_svg) {
  const fs::path file = folder / (name + ".gp");
  write_text(file, script(name, plot, before_svg));
  write_atomically(folder / (name + ".png"), [&](const fs::path& png) {
    write_atomically(folder / (name + ".svg"), [&](const fs::path& svg) {
      const std::string names = fmt::format("png_file = {}; svg_file = {}", gnuplot_text(png.filename().string()),
                                            gnuplot_text(svg.filename().string()));
      if (run_gnuplot(folder, {"-e", names, file.filename().string()}) != 0)
        throw Error(file.string(), "gnuplot failed on it, and said why above");
      for (const fs::path& picture : {png, svg})
        if (!is_whole_picture(picture))
          throw Error((folder / (name + picture.extension().string())).string(),
                      "cannot be written: gnuplot left it unfinished; is the disk full?");
    });
  });
}

void remove_drawing(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / (name + ".gp");
  if (!fs::is_regular_file(file) || !read_text(file).starts_with(head_of(name))) return;
  for (const char* extension : {".svg", ".png", ".gp"}) fs::remove(folder / (name + extension));
}

}  // namespace fathom
