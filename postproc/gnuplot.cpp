#include "postproc/gnuplot.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "assembly/atomic_file.hpp"

extern char** environ;

namespace cupola {
namespace {

/// Runs gnuplot on a script without a shell; its messages go to `log`. Returns its exit status.
int run_gnuplot(const std::string& script, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  char program[] = "gnuplot";
  std::string argument = script;
  char* const arguments[] = {program, argument.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return 127;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string in_folder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string draw(const std::string& folder, const Figure& figure, const char* terminal, const char* ending) {
  const std::string out = in_folder(folder, figure.name + ending);
  const std::string script = in_folder(folder, "." + figure.name + ".run.gp");
  const std::string log = in_folder(folder, "." + figure.name + ".log");
  std::string problem;
  write_atomically(out, [&](const std::string& side) {
    const std::string head = fmt::format(
        "set terminal {} size {},{} enhanced font 'DejaVu Sans,11' background '#ffffff'\n"
        "set output '{}'\nset termoption noenhanced\n",
        terminal, figure.width, figure.height, gnuplot_text(side));
    write_text_atomically(script, head + figure.commands + "unset output\n");
    const int status = run_gnuplot(script, log);
    if (status == 127) problem = "gnuplot is not installed";
    if (status != 0 && status != 127) problem = "gnuplot: " + first_line(read_text(log));
    if (!problem.empty()) write_text_atomically(side, "");
    return true;
  });
  std::filesystem::remove(script);
  std::filesystem::remove(log);
  if (!problem.empty()) std::filesystem::remove(out);
  return problem;
}

}  // namespace

std::vector<std::string> draw_figures(const std::string& folder, const std::vector<Figure>& figures) {
  make_folder(folder);
  std::vector<std::string> problems;
  for (const Figure& figure : figures) {
    write_text_atomically(
        in_folder(folder, figure.name + ".gp"),
        fmt::format("# {}\n# gnuplot -p {}.gp\n{}", figure.title, figure.name, figure.commands));
    std::string problem = draw(folder, figure, "pngcairo", ".png");
    if (problem.empty() && figure.vector) problem = draw(folder, figure, "svg", ".svg");
    if (!problem.empty()) problems.push_back(fmt::format("figure {} is not drawn: {}", figure.name, problem));
  }
  return problems;
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "${} << EOD\n", name);
  for (const auto& row : rows) {
    for (const double value : row)
      if (std::isfinite(value))
        fmt::format_to(std::back_inserter(out), "{:.9g} ", value);
      else
        fmt::format_to(std::back_inserter(out), "NaN ");
    out.push_back('\n');
  }
  fmt::format_to(std::back_inserter(out), "EOD\n");
  return fmt::to_string(out);
}

std::string gnuplot_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') out += '\'';  // doubled inside single quotes
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

}  // namespace cupola
