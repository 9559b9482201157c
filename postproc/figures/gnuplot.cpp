#include "postproc/figures/gnuplot.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/process.hpp"

namespace cupola {
namespace {

/// A temporary file, deleted at the end of its scope.
struct TemporaryFile {
  std::string path;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// Terminal and size of a file. A PDF has its size in inches of 96 pixels and its font in points.
std::string terminal_of(const Figure& figure, const std::string& ending) {
  if (ending == ".pdf")
    return fmt::format("pdfcairo size {:.3f}in,{:.3f}in font 'DejaVu Sans,9'", figure.width / 96.0,
                       figure.height / 96.0);
  return fmt::format("{} size {},{} font 'DejaVu Sans,12'", ending == ".svg" ? "svg" : "pngcairo",
                     figure.width, figure.height);
}

/// Replaces the date of a PDF, so that the same run writes the same bytes. Cairo 1.16 ignores
/// SOURCE_DATE_EPOCH.
void remove_date(const std::string& path) {
  const std::string key = "/CreationDate (D:", epoch = "19700101000000";
  std::string text = read_text(path);
  const size_t at = text.find(key);
  if (at == std::string::npos || at + key.size() + epoch.size() > text.size()) return;
  write_text_atomically(path, text.replace(at + key.size(), epoch.size(), epoch));
}

std::string draw(const std::string& folder, const Figure& figure, const char* ending) {
  const std::string out = in_folder(folder, figure.name + ending);
  const TemporaryFile script{in_folder(folder, "." + figure.name + ".run.gp")};
  const TemporaryFile log{in_folder(folder, "." + figure.name + ".log")};
  std::string problem;
  write_atomically(out, [&](const std::string& side) {
    const std::string head = fmt::format(
        "set terminal {} enhanced background '#ffffff'\nset output '{}'\nset termoption noenhanced\n",
        terminal_of(figure, ending), gnuplot_text(side));
    write_text_atomically(script.path, head + figure.commands + "unset output\n");
    const int status = run_process({"gnuplot", script.path}, log.path);
    if (status == kNotFound) problem = "gnuplot is not installed";
    if (status != 0 && status != kNotFound) problem = "gnuplot: " + last_line(read_text(log.path));
    if (problem.find("out of memory") != std::string::npos)
      throw SystemError(fmt::format("{}: gnuplot ran out of memory", out));
    // Without enough memory, Cairo writes nothing and reports no error.
    if (status == 0 && (!std::filesystem::exists(side) || std::filesystem::file_size(side) == 0))
      throw SystemError(fmt::format("{}: gnuplot wrote an empty file, as it does when memory runs out", out));
    if (!problem.empty()) write_text_atomically(side, "");
    if (problem.empty() && ending == std::string(".pdf")) remove_date(side);
    return true;
  });
  if (!problem.empty()) std::filesystem::remove(out);
  return problem;
}

}  // namespace

std::vector<std::string> draw_figures(const std::string& folder, const std::vector<Figure>& figures) {
  make_folder(folder);
  std::vector<std::string> problems;
  for (const Figure& figure : figures) {
    write_text_atomically(in_folder(folder, figure.name + ".gp"),
                          fmt::format("# {}\n# gnuplot -p {}.gp\n{}", gnuplot_text(figure.title), figure.name,
                                      figure.commands));
    std::string problem = draw(folder, figure, figure.vector ? ".svg" : ".png");
    if (problem.empty() && figure.vector) problem = draw(folder, figure, ".pdf");
    if (!problem.empty())
      problems.push_back(fmt::format("figure {} was not drawn: {}", figure.name, problem));
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

std::vector<PanelBox> panel_grid(size_t rows, size_t columns, const PanelBox& frame, double column_gap,
                                 double row_gap) {
  const auto m = static_cast<double>(rows), n = static_cast<double>(columns);
  const double width = (frame.right - frame.left - (n - 1.0) * column_gap) / n;
  const double height = (frame.top - frame.bottom - (m - 1.0) * row_gap) / m;
  std::vector<PanelBox> boxes;
  for (size_t i = 0; i < rows * columns; ++i) {
    const double left = frame.left + static_cast<double>(i % columns) * (width + column_gap);
    const double top = frame.top - static_cast<double>(i / columns) * (height + row_gap);
    boxes.push_back({left, left + width, top - height, top});
  }
  return boxes;
}

std::string panels(const std::vector<PanelBox>& boxes, const std::vector<std::string>& commands) {
  CUPOLA_ASSERT(commands.size() <= boxes.size());
  std::string out = "set multiplot\n";
  for (size_t i = 0; i < commands.size(); ++i)
    out += fmt::format(
               "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
               "set tmargin at screen {}\n",
               boxes[i].left, boxes[i].right, boxes[i].bottom, boxes[i].top) +
           commands[i];
  return out + "unset multiplot\n";
}

std::string gnuplot_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') out += '\'';                            // a single quote is doubled
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;  // a line end would start a new command
  }
  return out;
}

}  // namespace cupola
