// Claims: reduction of values, reading of the file, and verdicts on handwritten runs.
#include <cmath>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "postproc/claims/claims_report.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/tables/csv_file.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::claims_test {
namespace {

std::string claim_file(const std::string& body) {
  return "claims:\n  - says: a sentence\n    quote: a sentence of the paper\n" + body;
}

/// Writes a finished run `name` below the scratch folder.
void write_run(const ScratchFolder& scratch, const std::string& name, const std::string& status, double x) {
  scratch.write(name + "/results/summary.json",
                "{\"status\": \"" + status + "\", \"message\": \"at rest\", \"deep\": {\"list\": [1, " +
                    std::to_string(x) + "]}}");
  scratch.write(name + "/post/summary.json", "{\"inside\": true}");
  scratch.write(name + "/post/blocks.csv",
                "kind,ring,force_N\nstandard,0,10\nherringbone,0,30\n"
                "standard,1,20\n\"a, b\"\"c\",2,inf\n");
}

ClaimResult verdict(const ScratchFolder& scratch, const std::string& body) {
  return evaluate_claims(read_study(scratch.write("claims.yaml", claim_file(body))).claims, scratch.folder())
      .front();
}

TEST(Claims, ReduceGivesTheTextbookValues) {
  const std::vector<double> v = {1.0, 2.0, 3.0, 6.0};
  EXPECT_DOUBLE_EQ(reduce(Take::mean, v), 3.0);
  EXPECT_DOUBLE_EQ(reduce(Take::median, v), 2.5);
  EXPECT_DOUBLE_EQ(reduce(Take::largest, v), 6.0);
  EXPECT_DOUBLE_EQ(reduce(Take::smallest, v), 1.0);
  EXPECT_DOUBLE_EQ(reduce(Take::sum, v), 12.0);
  EXPECT_DOUBLE_EQ(reduce(Take::spread, v), 5.0 / 3.0);
  EXPECT_DOUBLE_EQ(reduce(Take::variation, v), std::sqrt(3.5) / 3.0);  // variance (4 + 1 + 0 + 9) / 4
  EXPECT_DOUBLE_EQ(reduce(Take::rms, v), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(reduce(Take::roughness, v), 1.0 / 3.0);  // second differences 0 and 2
  EXPECT_EQ(reduce(Take::first, v), 1.0);
  EXPECT_EQ(reduce(Take::last, v), 6.0);
  EXPECT_EQ(reduce(Take::count, v), 4.0);
  EXPECT_EQ(reduce(Take::count, {}), 0.0);
  EXPECT_EQ(reduce(Take::sum, {}), 0.0);
}

TEST(Claims, LinearityIsOneOnALineAndLessOtherwise) {
  EXPECT_DOUBLE_EQ(reduce(Take::linearity, {7.0, 5.0, 3.0}, {0.0, 1.0, 2.0}), 1.0);
  // x = -1, 0, 1 and y = 1, 0, 1 are uncorrelated
  EXPECT_DOUBLE_EQ(reduce(Take::linearity, {-1.0, 0.0, 1.0}, {1.0, 0.0, 1.0}), 0.0);
}

TEST(Claims, CsvKeepsQuotedCommasAndQuotes) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 2.0);
  const CsvFile csv = read_csv(scratch.file("a/post/blocks.csv"));
  EXPECT_EQ(csv.rows[3][0], "a, b\"c");
  EXPECT_TRUE(std::isinf(csv.number(3, csv.column("force_N"))));
  EXPECT_THROW(csv.column("forceN"), InputError);
  EXPECT_THROW(csv.number(0, csv.column("kind")), InputError);
  EXPECT_THROW(read_csv(scratch.write("bad.csv", "a,b\n1\n")), InputError);
}

TEST(Claims, KeysDescendIntoObjectsAndBooleansCountAsOneOrZero) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 2.5);
  EXPECT_DOUBLE_EQ(
      *verdict(scratch, "    value: {runs: a, key: results.deep.list.1}\n    paper: {at_least: 2.5}\n")
           .number,
      2.5);
  EXPECT_EQ(verdict(scratch, "    value: {runs: a, key: post.inside}\n    paper: {at_least: 1}\n").verdict,
            Verdict::reproduced);
  for (const char* key : {"results.deep.list.2", "results.deep", "results.nowhere", "elsewhere.x"})
    EXPECT_THROW(
        verdict(scratch, std::string("    value: {runs: a, key: ") + key + "}\n    paper: {at_least: 1}\n"),
        InputError)
        << key;
}

TEST(Claims, RowsAreSelectedDividedAndSubtracted) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 1.0);
  const std::string standard = "table: blocks, column: force_N, where: [{column: kind, is: standard}]";
  const ClaimResult r = verdict(
      scratch,
      "    value: {runs: a, table: blocks, column: force_N, where: [{column: kind, is: herringbone}]}\n"
      "    over: {runs: a, " +
          standard +
          ", take: mean}\n"
          "    minus: {runs: a, " +
          standard + ", take: smallest}\n    paper: {at_most: -8}\n");
  EXPECT_DOUBLE_EQ(*r.number, 30.0 / 15.0 - 10.0);
  EXPECT_EQ(r.verdict, Verdict::reproduced);
  EXPECT_DOUBLE_EQ(*verdict(scratch,
                            "    value: {runs: a a, table: blocks, column: force_N, take: sum, "
                            "where: [{column: ring, from: 0, to: 1}]}\n    paper: {at_least: 0}\n")
                        .number,
                   120.0);
  EXPECT_DOUBLE_EQ(*verdict(scratch,
                            "    value: {runs: a, reference: a, table: blocks, column: force_N, "
                            "take: rms, where: [{column: ring, to: 1}]}\n    paper: {at_most: 0}\n")
                        .number,
                   0.0);
}

TEST(Claims, VerdictsNameRunsThatAreMissingOrNotSolved) {
  const ScratchFolder scratch;
  write_run(scratch, "good", "stable", 1.0);
  write_run(scratch, "bad", "unconverged", 1.0);
  const std::string key = ", key: results.deep.list.1}\n";
  EXPECT_EQ(verdict(scratch, "    value: {runs: good" + key + "    paper: {at_least: 1.1}\n").verdict,
            Verdict::not_reproduced);
  EXPECT_EQ(verdict(scratch, "    value: {runs: good" + key + "    open: true\n").verdict, Verdict::open);
  const ClaimResult missing =
      verdict(scratch, "    value: {runs: absent" + key + "    paper: {at_least: 1}\n");
  EXPECT_EQ(missing.verdict, Verdict::not_run);
  EXPECT_EQ(missing.reason, "Not run: absent.");
  EXPECT_FALSE(missing.number);
  const ClaimResult unsolved = verdict(scratch, "    value: {runs: bad" + key + "    paper: {at_least: 0}\n");
  EXPECT_EQ(to_string(unsolved.verdict), "not reproduced: not solved");
  EXPECT_FALSE(unsolved.number);
  // An unconverged run neither stands nor falls, even where the claim asks how runs end.
  for (const char* status : {"stable", "unconverged"})
    EXPECT_EQ(verdict(scratch, std::string("    value: {runs: bad, status: ") + status +
                                   "}\n    paper: {at_most: 1}\n")
                  .verdict,
              Verdict::not_solved);
  // Numbers of the note come from solved runs too.
  EXPECT_EQ(verdict(scratch, "    value: {runs: good" + key + "    paper: {at_least: 0}\n" +
                                 "    also: [{name: x, value: {runs: bad, key: results.deep.list.1}}]\n")
                .verdict,
            Verdict::not_solved);
  write_run(scratch, "fallen", "collapsed", 1.0);
  EXPECT_DOUBLE_EQ(
      *verdict(scratch, "    value: {runs: good fallen, status: stable}\n    paper: {at_least: 1}\n").number,
      0.5);
}

TEST(Claims, PaperAndOwnLimitsBothApplyAndOwnStatementsHoldOrNot) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 2.0);
  const std::string value = "    value: {runs: a, key: results.deep.list.1}\n";
  const std::string ours = "    ours: {at_most: 1.5, reason: r}\n";
  EXPECT_EQ(verdict(scratch, value + "    paper: {at_least: 1}\n").verdict, Verdict::reproduced);
  EXPECT_EQ(verdict(scratch, value + "    paper: {at_least: 1}\n" + ours).verdict, Verdict::not_reproduced);
  const auto own = [&](const std::string& limits) {
    const std::string path = scratch.write("own.yaml", "claims:\n  - says: a\n" + value + limits);
    return evaluate_claims(read_study(path).claims, scratch.folder()).front().verdict;
  };
  EXPECT_EQ(own("    ours: {at_least: 1.5, reason: r}\n"), Verdict::holds);
  EXPECT_EQ(own(ours), Verdict::does_not_hold);
}

TEST(Claims, EachRunIsTestedByItself) {
  const ScratchFolder scratch;
  write_run(scratch, "s1", "stable", 1.0);
  write_run(scratch, "s2", "stable", 2.0);
  write_run(scratch, "s3", "stable", 6.0);
  const std::string body =
      "    each_run: true\n    value: {runs: s1 s2 s3, key: results.deep.list.1}\n    paper: {at_most: ";
  const ClaimResult all = verdict(scratch, body + "6}\n");
  EXPECT_EQ(all.verdict, Verdict::reproduced);
  EXPECT_EQ(all.numbers, (std::vector{1.0, 2.0, 6.0}));
  EXPECT_DOUBLE_EQ(*all.number, 3.0);
  const ClaimResult some = verdict(scratch, body + "5}\n");  // the mean lies within the limits
  EXPECT_EQ(some.verdict, Verdict::not_reproduced);
  EXPECT_EQ(some.reason, "Within the limits in 2 of 3 runs.");
  // As many divisors as values: run by run.
  const ClaimResult paired =
      verdict(scratch, body + "1}\n    over: {runs: s1 s2 s3, key: results.deep.list.1}\n");
  EXPECT_EQ(paired.numbers, (std::vector{1.0, 1.0, 1.0}));
  const ClaimResult divided = verdict(scratch, body + "1}\n    over: {runs: s3, key: results.deep.list.1}\n");
  EXPECT_EQ(divided.numbers, (std::vector{1.0 / 6.0, 2.0 / 6.0, 1.0}));
}

TEST(Claims, NotesTakeTheirNumbersFromTheRuns) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 2.0);
  write_run(scratch, "b", "stable", 8.0);
  const std::string claim =
      "    value: {runs: b, key: results.deep.list.1}\n    over: {runs: a, key: results.deep.list.1}\n"
      "    paper: {at_least: 1}\n    also: [{name: other, value: {runs: a, key: results.deep.list.1}, "
      "over: {runs: b, key: results.deep.list.1}}]\n";
  EXPECT_EQ(verdict(scratch, claim + "    note: \"{value} over {over}, {other}, {message}\"\n").note,
            "4 over 2, 0.25, at rest");
  write_run(scratch, "b", "stable", 16.0);
  EXPECT_EQ(verdict(scratch, claim + "    note: \"{value}\"\n").note, "8");
  for (const char* note : {"a fixed 4", "{minus}", "{unknown}", "{value"})
    EXPECT_THROW(verdict(scratch, claim + "    note: \"" + note + "\"\n"), InputError) << note;
}

TEST(Claims, FileIsReadStrictly) {
  const ScratchFolder scratch;
  const std::string value = "    value: {runs: a, key: results.x}\n", paper = "    paper: {at_least: 1}\n";
  EXPECT_NO_THROW(read_study(scratch.write("claims.yaml", claim_file(value + paper))));
  for (const std::string& body :
       {"    value: {runs: a, key: x, status: stable}\n" + paper,  // two sources
        "    value: {runs: a, table: t}\n" + paper,                // no column
        "    value: {key: results.x}\n" + paper,                   // no run
        value,                                                     // no limits
        value + paper + "    open: true\n",                        // limits of an open question
        value + "    ours: {at_least: 1}\n",                       // no reason
        value + paper + "    ours: {reason: none}\n",              // a reason for nothing
        value + "    paper: {atleast: 1}\n",                       // unknown key
        value + paper +
            "    each_run: true\n    over: {runs: a b, key: results.x}\n",  // neither one nor as many
        std::string("    value: {runs: a, table: t, column: c, take: linearity}\n    open: true\n"),
        value + "    open: true\nfigures: [{source: F, run: a}]\n"})
    EXPECT_THROW(read_study(scratch.write("claims.yaml", claim_file(body))), InputError) << body;
  // Limits of the publication need its sentence.
  EXPECT_THROW(read_study(scratch.write("claims.yaml", "claims:\n  - says: a\n" + value + paper)),
               InputError);
}

TEST(Claims, ReportShowsEveryVerdictAndEscapesText) {
  const ScratchFolder scratch;
  write_run(scratch, "a", "stable", 2.0);
  const Study file = read_study(scratch.write(
      "claims.yaml",
      "claims:\n  - {says: a < b, quote: q & a, value: {runs: a, key: results.deep.list.1}, paper: "
      "{at_least: 1}}\n"
      "  - {says: gone, value: {runs: b, key: results.x}, ours: {at_least: 1, reason: because}}\n"
      "figures:\n  - {source: Fig. 1, shows: x > y, run: a, picture: figures/a.svg}\n"
      "  - {source: Fig. 2, run: c, picture: figures/c.svg}\n"));
  scratch.write("a/post/figures/a.svg", "<svg/>");
  const auto& claims = file.claims;
  const auto results = evaluate_claims(claims, scratch.folder());
  const std::string html = claims_html(claims, results) + figures_html(file.figures, scratch.folder()),
                    text = claims_text(claims, results);
  for (const char* part : {"a &lt; b", "“q &amp; a”", "at least 1 (paper)", "at least 1 (ours: because)"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_NE(text.find("2 claims: 1 reproduced, 1 not run"), std::string::npos) << text;
  EXPECT_EQ(claims_table(claims, results).rows.size(), 2u);
  EXPECT_EQ(needed_runs(claims, file.figures), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_NE(html.find("<img alt=\"x &gt; y\" src=\"data:image/svg"), std::string::npos);
  EXPECT_NE(html.find("Not drawn yet: figures/c.svg of the run c."), std::string::npos);
}

}  // namespace
}  // namespace cupola::claims_test
