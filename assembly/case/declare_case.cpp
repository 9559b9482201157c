#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_swept_key(Section& s, SweptKey& swept) {
  s.text("key", swept.key, "path of a key of this case, as after --set");
  s.texts("values", swept.values, "what it takes in turn");
  s.rule(!swept.key.empty(), "key", "must be given");
  s.rule(!swept.values.empty(), "values", "must hold at least one value");
}

}  // namespace

void declare_case(Section& s, Case& the_case) {
  s.text("title", the_case.title, "one line for reports and pictures");
  s.section("geometry", the_case.geometry, "what is built", declare_geometry);
  s.optional_section("imperfections", the_case.geometry.imperfections, "seeded deviations from the drawing",
                     declare_imperfections);
  s.section("material", the_case.material, "the blocks", declare_material);
  s.section("joints", the_case.joints, "what happens between blocks", declare_joints);
  s.section("contact", the_case.contact, "how contacts are found", declare_contact);
  s.section("loads", the_case.loads, "what acts on the blocks", declare_loads);
  s.section("ties", the_case.ties, "ties and chains that pull between blocks", declare_ties);
  s.section("supports", the_case.supports, "motion imposed on fixed blocks", declare_supports);
  s.section("analysis", the_case.analysis, "what is computed", declare_analysis);
  s.section("output", the_case.output, "what is written while solving", declare_output);
  s.section("postproc", the_case.postproc, "what is drawn and tabulated", declare_postproc);
  s.list("sweep", the_case.sweep, "a study: keys that take several values, each with each",
         declare_swept_key);
}

}  // namespace cupola
