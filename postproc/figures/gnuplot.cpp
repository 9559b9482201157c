#include "postproc/figures/gnuplot.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/process.hpp"

namespace cupola {
namespace {

/// A folder that is deleted with its files at the end of its scope.
struct TemporaryFolder {
  std::string path;
  explicit TemporaryFolder(std::string name) : path(std::move(name)) { make_folder(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// Terminal and size of a file. A PDF has its size in inches of 96 pixels and its font in points.
std::string terminal_of(const Figure& figure, const std::string& ending) {
  if (ending == ".pdf")
    return fmt::format("pdfcairo size {:.3f}in,{:.3f}in font 'DejaVu Sans,9'", figure.width / 96.0,
                       figure.height / 96.0);
  return fmt::format("{} size {},{} font 'DejaVu Sans,12'", ending == ".svg" ? "svg" : "pngcairo",
                     figure.width, figure.height);
}

/// Replaces the date in the text of a PDF, so that the same run writes the same bytes. Cairo 1.16 ignores
/// SOURCE_DATE_EPOCH.
void remove_date(std::string* text) {
  const std::string key = "/CreationDate (D:", epoch = "19700101000000";
  const size_t at = text->find(key);
  if (at == std::string::npos || at + key.size() + epoch.size() > text->size()) return;
  text->replace(at + key.size(), epoch.size(), epoch);
}

/// A file that gnuplot draws.
struct Drawing {
  const Figure* figure;
  std::string script;  ///< file of the figure's commands
  std::string ending;
  std::string path, side;  ///< its place, and where it is until it is complete
  std::string problem;
};

std::string commands_of(const Drawing& drawing) {
  return fmt::format(
      "reset session\nset terminal {} enhanced background '#ffffff'\nset output '{}'\n"
      "set termoption noenhanced\nload '{}'\nunset output\n",
      terminal_of(*drawing.figure, drawing.ending), gnuplot_text(drawing.side), gnuplot_text(drawing.script));
}

constexpr const char* kDrawn = "cupola: drawn";  // printed after each drawing

size_t num_drawn(const std::string& log) {
  size_t count = 0;
  for (size_t at = 0; (at = log.find(fmt::format("{}\n", kDrawn), at)) != std::string::npos; ++at) ++count;
  return count;
}

/// Draws the figures from `first` on in one process, whose start takes as long as two drawings. Returns the
/// first that was not drawn, with its problem, or the end.
size_t draw(const TemporaryFolder& folder, size_t first, std::vector<Drawing>* drawings) {
  const std::string script = in_folder(folder.path, "run.gp"), log = in_folder(folder.path, "run.log");
  std::string commands;
  for (size_t k = first; k < drawings->size(); ++k)
    commands += commands_of((*drawings)[k]) + fmt::format("print '{}'\n", kDrawn);
  write_text_atomically(script, commands);
  write_text_atomically(log, "");  // a program that does not start writes none
  std::string cause;
  try {
    const int status = run_process({"gnuplot", "-d", script}, log);  // -d: ignore the user's ~/.gnuplot
    if (status == 0) return drawings->size();
    if (status == kNotFound) {
      for (Drawing& drawing : *drawings) drawing.problem = "gnuplot is not installed";
      return drawings->size();
    }
    cause = "gnuplot: " + last_line(read_text(log));
  } catch (const SystemError& error) {
    cause = error.what();
  }
  const size_t failed = first + num_drawn(read_text(log));
  if (failed < drawings->size()) (*drawings)[failed].problem = cause;
  return failed;
}

/// Moves a complete file to its place, or removes the one that an earlier run left.
void put_in_place(Drawing* drawing) {
  // Without enough memory, Cairo writes nothing and reports no error.
  if (drawing->problem.empty() &&
      (!std::filesystem::exists(drawing->side) || std::filesystem::file_size(drawing->side) == 0))
    drawing->problem = "gnuplot wrote an empty file, as it does when memory runs out";
  if (!drawing->problem.empty()) {
    std::filesystem::remove(drawing->path);
    return;
  }
  std::string text = read_text(drawing->side);
  if (drawing->ending == ".pdf") remove_date(&text);
  write_text_atomically(drawing->path, text);
}

}  // namespace

std::string picture_file(const std::string& folder, const Figure& figure) {
  return in_folder(folder, figure.name + (figure.vector ? ".svg" : ".png"));
}

std::vector<std::string> draw_figures(const std::string& folder, const std::vector<Figure>& figures) {
  make_folder(folder);
  const TemporaryFolder side(in_folder(folder, ".drawing"));
  std::vector<Drawing> drawings;
  for (const Figure& figure : figures) {
    const std::string script = in_folder(folder, figure.name + ".gp");
    write_text_atomically(
        script,
        fmt::format("# {}\n# gnuplot -p {}.gp\n", gnuplot_text(figure.title), figure.name) + figure.commands);
    const auto add = [&](const char* ending) {
      const std::string name = figure.name + ending;
      drawings.push_back({&figure, script, ending, in_folder(folder, name), in_folder(side.path, name), ""});
    };
    add(figure.vector ? ".svg" : ".png");
    if (figure.vector) add(".pdf");
  }
  // gnuplot ends at the first error; the figures after it are drawn by another process.
  for (size_t next = 0; next < drawings.size();) {
    const size_t failed = next = draw(side, next, &drawings);
    while (next < drawings.size() && drawings[next].figure == drawings[failed].figure)
      drawings[next++].problem = drawings[failed].problem;
  }
  std::vector<std::string> problems;
  const Figure* reported = nullptr;
  for (Drawing& drawing : drawings) {
    put_in_place(&drawing);
    if (drawing.problem.empty() || reported == drawing.figure) continue;
    reported = drawing.figure;
    problems.push_back(fmt::format("figure {} was not drawn: {}", reported->name, drawing.problem));
  }
  return problems;
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
  std::string out = fmt::format("${} << EOD\n", name);
  std::array<char, 32> digits{};
  for (const auto& row : rows) {
    for (const double value : row) {
      const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                              std::chars_format::general, /*precision=*/9);
      out.append(std::isfinite(value) ? std::string_view(digits.data(), end) : "NaN").push_back(' ');
    }
    out.push_back('\n');
  }
  return out + "EOD\n";
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
