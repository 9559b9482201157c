#pragma once

#include <gtest/gtest.h>

#include "assembly/files/assembly_file.hpp"
#include "postproc/analyse.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::test {

/// Analyses frames of a column of three blocks in a fresh folder and returns its folder post/.
inline std::string analysed_column(const std::string& name, const std::vector<Frame>& frames,
                                   const Summary& summary, const Assembly& a = column(3)) {
  const std::string folder = fresh_folder(name);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  write_frames(frames, summary, &writer);
  writer.write_text("run.yaml", "title: column\n");
  writer.write_summary(summary);
  AnalyseRequest request;
  request.run = {column_case(), folder + "/assembly.vtu", folder + "/results"};
  request.output_folder = folder + "/post";
  request.quiet = true;
  EXPECT_EQ(analyse(request), ExitCode::done);
  return folder + "/post";
}

}  // namespace cupola::test
