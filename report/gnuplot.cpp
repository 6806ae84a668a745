#include "report/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "report/gnuplot_text.h"
#include "report/whole_picture.h"

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

/// This process' environment, but that texts are UTF-8: in another locale gnuplot complains of what it cannot convert.
std::vector<std::string> utf8_environment() {
  std::vector<std::string> variables{"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable; ++variable)
    if (!std::string_view(*variable).starts_with("LC_ALL=")) variables.emplace_back(*variable);
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// All that comes out of a pipe until its writers have closed it.
std::string drained(int pipe) {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t size; (size = ::read(pipe, piece.data(), piece.size())) != 0;) {
    if (size > 0) text.append(piece.data(), static_cast<std::size_t>(size));
    if (size < 0 && errno != EINTR) break;
  }
  return text;
}

struct GnuplotRun {
  int exit_code;
  std::string said;  ///< on stderr
};

/// Runs `gnuplot -d …`, without the user's own settings, started in `folder`. It ends when this process does, so that
/// nobody writes into the folder of a run that was killed.
GnuplotRun run_gnuplot(const fs::path& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"gnuplot", "-d"});
  std::vector<std::string> variables = utf8_environment();
  const std::vector<char*> arguments = pointers_to(words), environment = pointers_to(variables);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw Error("gnuplot", std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent && ::chdir(folder.c_str()) == 0 && ::dup2(ends[1], STDERR_FILENO) >= 0)
      ::execvpe(arguments.front(), arguments.data(), environment.data());
    ::_exit(kNotInstalled);
  }
  const int problem = errno;
  ::close(ends[1]);
  GnuplotRun run{-1, child < 0 ? std::string() : drained(ends[0])};
  ::close(ends[0]);
  if (child < 0) throw Error("gnuplot", std::strerror(problem));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error("gnuplot", std::strerror(errno));
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (run.exit_code == kNotInstalled)
    throw Error("gnuplot", "is not installed, and draws the figures; install gnuplot-nox");
  return run;
}

/// The last line that is not blank, which is gnuplot's reason.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);  // npos + 1 is 0
}

}  // namespace

void require_gnuplot() {
  if (run_gnuplot(".", {"-e", "exit"}).exit_code != 0) throw Error("gnuplot", "does not run, and draws the figures");
}

void draw(const fs::path& folder, const std::string& name, const std::string& plot, const std::string& before_svg) {
  const fs::path file = folder / (name + ".gp");
  write_text(file, script(name, plot, before_svg));
  write_atomically(folder / (name + ".png"), [&](const fs::path& png) {
    write_atomically(folder / (name + ".svg"), [&](const fs::path& svg) {
      const std::string names = fmt::format("png_file = {}; svg_file = {}", gnuplot_text(png.filename().string()),
                                            gnuplot_text(svg.filename().string()));
      const GnuplotRun run = run_gnuplot(folder, {"-e", names, file.filename().string()});
      if (run.exit_code != 0) throw Error(file.string(), fmt::format("gnuplot failed on it: {}", last_line(run.said)));
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
