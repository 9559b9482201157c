#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/case_tree.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::case_error_test {
namespace {

/// The message of the error that reading this case file raises, without the folder.
std::string message_for(const std::string& text, const std::vector<std::string>& set_options = {}) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("bad.yaml", text);
  try {
    read_case(path, set_options);
  } catch (const InputError& error) {
    std::string message = error.what();
    for (size_t at; (at = message.find(scratch.folder() + "/")) != std::string::npos;)
      message.erase(at, scratch.folder().size() + 1);
    return message;
  }
  return "no error";
}

const std::string kGood =
    "geometry:\n"
    "  surface: {type: dome}\n"
    "  bond: {type: running}\n"
    "joints:\n"
    "  compliance: {per: point}\n";

/// The least that makes a case.
const std::string kDome = "geometry: {surface: {type: dome}, bond: {type: running}}\n";

struct BadCase {
  std::string name;
  std::string text;
  std::string expected;  ///< start of the message; lists of valid names may follow
};

class BadCaseFile : public ::testing::TestWithParam<BadCase> {};

/// Name of the case in test listings.
void PrintTo(const BadCase& bad, std::ostream* out) {
  *out << bad.name;
}

TEST_P(BadCaseFile, GivesOneLineWithPlaceKeyAndRule) {
  const std::string message = message_for(GetParam().text);
  EXPECT_EQ(message.substr(0, GetParam().expected.size()), GetParam().expected) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const BadCase kBadCases[] = {
    {"Negative", kGood + "  friction: -0.4\n", "bad.yaml:6:13: error: joints.friction = -0.4: must be >= 0"},
    {"Nan", kGood + "  friction: .nan\n", "bad.yaml:6:13: error: joints.friction = .nan: must be a number"},
    {"KindOfNoLetter",
     "geometry: {surface: {type: wall}, bond: {type: drawn, letter_length: 1, rows: [ab], kinds: {z: "
     "flat}}}\n",
     "bad.yaml:1:93: error: geometry.bond.kinds.z: unknown key; did you mean a?"},
    {"LeaningDome", "geometry: {affine: {lean: 0.2}, surface: {type: dome}, bond: {type: running}}\n",
     "bad.yaml:1:20: error: geometry.affine = {...}: lean and rake require an arch or barrel; a leaning "
     "tower "
     "stands upright under a tilted loads.gravity"},
    {"NanWord", kGood + "  friction: nan\n",
     "bad.yaml:6:13: error: joints.friction = nan: must be a finite number"},
    {"Infinite", kGood + "  friction: inf\n",
     "bad.yaml:6:13: error: joints.friction = inf: must be a finite number"},
    {"Overflow", kGood + "  friction: 1e400\n",
     "bad.yaml:6:13: error: joints.friction = 1e400: exceeds the range of double precision"},
    {"Hexadecimal", kGood + "  friction: 0x10\n",
     "bad.yaml:6:13: error: joints.friction = 0x10: must be a number"},
    {"YesIsNoNumber", kGood + "  friction: yes\n",
     "bad.yaml:6:13: error: joints.friction = yes: must be a number"},
    {"QuotedNumber", kGood + "  friction: \"0.4\"\n",
     "bad.yaml:6:13: error: joints.friction = \"0.4\": must be a number"},
    {"ListForNumber", kGood + "  friction: [0.4]\n",
     "bad.yaml:6:13: error: joints.friction = [...]: must be a single value"},
    {"EmptyValue", kGood + "  friction:\n",
     "bad.yaml:6:3: error: joints.friction is empty: give a value or remove the key"},
    {"UnknownKey", kGood + "  frictoin: 0.4\n",
     "bad.yaml:6:3: error: joints.frictoin: unknown key; did you mean friction? Valid keys here: friction, "
     "compliance"},
    {"DecimalComma", kGood + "  friction: 0,2\n",
     "bad.yaml:6:13: error: joints.friction = 0,2: must be a number; a decimal comma? Write 0.2"},
    {"DecimalCommaInAMap", "joints: {friction: 0,25, compliance: {per: point}}\n" + kDome,
     "bad.yaml:1:22: error: joints.25: unknown key; a decimal comma? Write friction: 0.25. Valid keys"},
    {"DecimalCommaBeforeMissingKeys", "loads: {lantern: {}}\njoints: {friction: 0,25}\n" + kDome,
     "bad.yaml:2:22: error: joints.25: unknown key; a decimal comma? Write friction: 0.25. Valid keys"},
    {"UnknownSectionBeforeMissingKeys", kDome + "lods: {}\n",
     "bad.yaml:2:1: error: lods: unknown key; did you mean loads?"},
    {"OtherName", kGood + "  mu: 0.4\n",
     "bad.yaml:6:3: error: joints.mu: unknown key; did you mean joints.friction or joints.bed.friction"},
    {"RetiredWeld", "geometry: {import: {weld: 1e-3}}\n",
     "bad.yaml:1:27: error: geometry.import.weld = 1e-3: this key no longer exists; remove it: vertices "
     "closer than 1e-6 of the block size are merged"},
    {"RetiredSettledSpeed", kGood + "analysis: {stop: {settled_speed: 1e-3}}\n",
     "bad.yaml:6:34: error: analysis.stop.settled_speed = 1e-3: this key no longer exists; remove it"},
    {"RetiredKey", "geometry: {import: {most_overlap: 1e-3}}\n",
     "bad.yaml:1:35: error: geometry.import.most_overlap = 1e-3: this key no longer exists; contact.margin "
     "is"},
    {"BlockIsAList", kGood + "loads: {forces: [{block: [1]}]}\n",
     "bad.yaml:6:26: error: loads.forces[0].block = [...]: must be a single value"},
    {"NegativeBlock", kGood + "loads: {forces: [{block: -1}]}\n",
     "bad.yaml:6:26: error: loads.forces[0].block = -1: must be >= 0"},
    {"MisspeltSweptKey", kGood + "sweep: [{key: joints.frction, values: [0.1]}]\n",
     "bad.yaml:6:15: error: sweep: --set joints.frction=0.1: error: joints.frction: unknown key; did you "
     "mean "
     "friction?"},
    {"KeySweptTwice",
     kGood + "sweep: [{key: joints.friction, values: [0.1]}, {key: joints.friction, values: [0.2]}]\n",
     "bad.yaml:6:8: error: sweep = [...]: names a key twice"},
    {"SweptValueOutOfRange", kGood + "sweep: [{key: joints.friction, values: [0.1, -2]}]\n",
     "bad.yaml:6:15: error: sweep: --set joints.friction=-2: error: joints.friction = -2: must be >= 0"},
    {"BundledCaseMisspelt", "extends: cupola:dome_circlar\n",
     "bad.yaml:1:10: error: cupola:dome_circlar: no bundled case has this name; did you mean "
     "cupola:dome_circular?"},
    {"BundledCaseWithEnding", "extends: cupola:arch.yaml\n",
     "bad.yaml:1:10: error: cupola:arch.yaml: no bundled case has this name; did you mean cupola:arch?"},
    {"BundledCaseOutside", "extends: cupola:../cases/dome_circular\n",
     "bad.yaml:1:10: error: cupola:../cases/dome_circular: no bundled case has this name"},
    {"UnknownSection", kGood + "walls: 3\n",
     "bad.yaml:6:1: error: walls: unknown key. Valid keys here: title, geometry, "},
    {"UnknownPreset", kGood + "analysis: {accuracy: drat}\n",
     "bad.yaml:6:22: error: analysis.accuracy = drat: did you mean draft? It must be one of custom, draft, "},
    {"WrenchErrorOfMotion", kGood + "analysis: {type: dynamic, accuracy: {wrench_error: 1e-3}}\n",
     "bad.yaml:6:37: error: analysis.accuracy = {...}: wrench_error is for static analysis only"},
    {"DirectLimitUnderCoulomb",
     kGood + "analysis: {type: limit, friction_law: coulomb, limit: {method: direct}}\n", "bad.yaml:6:"},
    {"DirectLimitOfASpread", kGood + "analysis: {type: limit, limit: {method: direct, parameter: spread}}\n",
     "bad.yaml:6:41: error: analysis.limit.method = direct: direct does not apply to spread"},
    {"RangeWithoutQuantities", kGood + "analysis: {type: range}\n",
     "bad.yaml:6:11: error: analysis.range: must list at least one quantity: {quantities: [thrust]}"},
    {"UnknownQuantity", kGood + "analysis: {range: {quantities: [trust]}}\n",
     "bad.yaml:6:33: error: analysis.range.quantities[0].type = trust: did you mean thrust? It must be one "
     "of "},
    {"JointOfOneBlock",
     kGood + "analysis: {range: {quantities: [{type: joint, blocks: [3], component: normal}]}}\n",
     "bad.yaml:6:55: error: analysis.range.quantities[0].blocks = [...]: must name the two blocks of the "
     "joint: "},
    {"JointWithoutComponent", kGood + "analysis: {range: {quantities: [{type: joint, blocks: [3, 4]}]}}\n",
     "bad.yaml:6:33: error: analysis.range.quantities[0].component is missing and has no default; normal "
     "is "},
    {"ShareOfNothing", kGood + "analysis: {range: {quantities: [share]}}\n",
     "bad.yaml:6:33: error: analysis.range.quantities[0].of: must be ribs, mid_sails or herringbone, or "
     "list "},
    {"MisspeltBlock", kGood + "loads: {forces: [{blok: 3, force: [0, 0, -1]}]}\n",
     "bad.yaml:6:18: error: loads.forces[0].block: give the loaded block, a point or `over`; is blok a "
     "misspelling of block?"},
    {"BisectionOfJointExtent",
     kGood + "analysis: {type: limit, limit: {low: 0.1, method: bisection, parameter: joint_extent}}\n",
     "bad.yaml:6:51: error: analysis.limit.method = bisection: bisection does not apply to joint_extent"},
    {"MisspeltChoice", kGood + "analysis: {type: dinamic}\n",
     "bad.yaml:6:18: error: analysis.type = dinamic: did you mean dynamic? It must be one of static, "
     "dynamic, "},
    {"DuplicateKey", kGood + "joints: {}\n",
     "bad.yaml:6:1: error: the key joints is given twice, first on line 4"},
    {"BothWeights", kGood + "material: {unit_weight: 1, density: 1}\n",
     "bad.yaml:6:37: error: material.density = 1: give unit_weight or density, not both"},
    {"ZeroWeight", kGood + "material: {unit_weight: 0}\n",
     "bad.yaml:6:25: error: material.unit_weight = 0: must be > 0"},
    {"TwoGravityNumbers", kGood + "loads: {gravity: [0, 1]}\n",
     "bad.yaml:6:18: error: loads.gravity = [...]: must be a list of three numbers, [x, y, z]"},
    {"MissingPer", kDome + "joints: {compliance: {normal: 1e-9}}\n",
     "bad.yaml:2:22: error: joints.compliance.per is missing and has no default; choose point (normal "
     "and tangential in m/N for each contact point, as in the paper, by default 1e-08 and 1e-08) or area"},
    {"RelativeAndPer", kDome + "joints: {compliance: {relative: 1e-4, per: area}}\n",
     "bad.yaml:2:44: error: joints.compliance.per = area: `relative` stands alone: leave out either it or "
     "per"},
    {"MissingSurfaceType", "geometry: {surface: {span: 3}}\n",
     "bad.yaml:1:21: error: geometry.surface.type is missing and has no default; give one of dome, "},
    {"MisspeltType", "geometry: {surface: {typ: dome}}\n",
     "bad.yaml:1:21: error: geometry.surface.type is missing and has no default; give one of dome, "
     "octagonal_vault, arch, wall, vault; is typ a misspelling of type?"},
    {"MissingRequiredNumber", kGood + "loads: {lantern: {}}\n",
     "bad.yaml:6:18: error: loads.lantern.weight_fraction: give one of weight_fraction, weight (N) and mass"},
    {"KeyOfAnotherType", "geometry: {surface: {type: wall, span: 3}}\n",
     "bad.yaml:1:34: error: geometry.surface.span: unknown key. Valid keys here: type, length, height, "
     "thickness"},
    {"ZeroRings", "geometry: {surface: {type: dome}, bond: {type: running, rings: 0}}\n",
     "bad.yaml:1:64: error: geometry.bond.rings = 0: must be >= 1 and <= 100000"},
    {"FractionOfRing", "geometry: {surface: {type: dome}, bond: {type: running, rings: 3.5}}\n",
     "bad.yaml:1:64: error: geometry.bond.rings = 3.5: must be a whole number"},
    {"OddSlices", "geometry: {surface: {type: dome}, bond: {type: running, slices_per_block: 3}}\n",
     "bad.yaml:1:75: error: geometry.bond.slices_per_block = 3: must be even, because odd rings are shifted "
     "by half a block"},
    {"TooManyCells",
     "geometry: {surface: {type: dome}, bond: {type: running, rings: 100000, blocks_per_ring: 9999}}\n",
     "bad.yaml:1:89: error: geometry.bond.blocks_per_ring = 9999: rings x blocks_per_ring x slices x "
     "refine^2 must be <= 2e7 cells"},
    {"TooFewAround", "geometry: {surface: {type: dome}, bond: {type: running, blocks_per_ring: 2}}\n",
     "bad.yaml:1:41: error: geometry.bond = {...}: bond.blocks_per_ring must be >= 3 on a closed ring"},
    {"MeridianNotAMap", kGood + "postproc: {meridians: [mid_sail]}\n",
     "bad.yaml:6:24: error: postproc.meridians[0] = mid_sail: must be a map, {key: value}"},
    {"MeridianOutside", kGood + "postproc: {meridians: [{name: ../../rib, azimuth_deg: 0}]}\n",
     "bad.yaml:6:31: error: postproc.meridians[0].name = ../../rib: may contain only letters, digits, _ and "
     "-"},
    {"MeridianWithACommand",
     kGood + "postproc: {meridians: [{name: \"a\\nsystem('touch x')\", azimuth_deg: 0}]}\n",
     "bad.yaml:6:31: error: postproc.meridians[0].name = \"a?system('touch x')\": may contain only letters, "
     "digits, _ and -"},
    {"AnchorsOfAThickness",
     "geometry: {surface: {type: dome}, bond: {type: running}, chains: [{name: a, type: polygon, height: 7, "
     "place: 0.25, links: 8, axial_stiffness: 1e8}]}\n"
     "analysis: {type: limit, limit: {parameter: thickness, low: 0.5, high: 1}}\n",
     "bad.yaml:2:44: error: analysis.limit.parameter: requires chains and rods with place: 0.5"},
    {"EnergiesOfJointsThatYield",
     kDome + "joints: {compliance: {per: area}, tension: 1e5, fracture_energy: {tension: 10, shear: 10}}\n",
     "bad.yaml:2:66: error: joints.fracture_energy = {...}: requires joints.failure: softening, or that it "
     "is given "
     "as "
     "plastic"},
    {"NotAMap", "- a\n- b\n", "bad.yaml:1:1: error: a case file is a map of sections, `key: value`"},
    {"Empty", "", "bad.yaml: error: is empty"},
    {"OnlyComment", "# nothing\n", "bad.yaml: error: is empty"},
    {"TwoDocuments", kGood + "---\ntitle: x\n",
     "bad.yaml:7:1: error: a second YAML document starts here; a case file holds only one"},
    {"Anchor", "title: &a x\n",
     "bad.yaml:1:8: error: anchors (&) and aliases (*) are not allowed; use `extends`"},
    {"Alias", "title: *a\n", "bad.yaml:1:8: error: not valid YAML: the referenced anchor is not defined"},
    {"Tag", "title: !!binary aGk=\n", "bad.yaml:1:8: error: the tag tag:yaml.org,2002:binary is not allowed"},
    {"Tab", "joints:\n\tfriction: 1\n", "bad.yaml:2:1: error: the line is indented with a tab; use spaces"},
    {"NotUtf8", "title: caf\xe9\n", "bad.yaml:1:11: error: not UTF-8 text"},
    {"ControlCharacter", "title: a\x01z\n", "bad.yaml:1:9: error: control character 0x01"},
    {"UnclosedList", "title: [1, 2\n", "bad.yaml:2:1: error: not valid YAML: end of sequence flow not found"},
    {"MapAsKey", "{{a: b}: c}\n", "bad.yaml:1:2: error: a key must be a name, not a list or a map"},
    {"DeepNesting", std::string(5000, '[') + std::string(5000, ']'),
     "bad.yaml:1:33: error: nested deeper than 32 levels"},
    {"Circle", "extends: bad.yaml\n",
     "bad.yaml:1:10: error: extends = bad.yaml: the files extend one another in a circle"},
    {"ExtendsNothing", "extends: none.yaml\n", "bad.yaml:1:10: error: extends = none.yaml: no such file"},
    {"Escape", "extends: ../../etc/passwd\n",
     "bad.yaml:1:10: error: ../../etc/passwd: the file must lie in or below the folder of the case"},
    {"EscapeAbsolute", "extends: /etc/passwd\n",
     "bad.yaml:1:10: error: /etc/passwd: the file must lie in or below the folder of the case"},
};

INSTANTIATE_TEST_SUITE_P(CaseReader, BadCaseFile, ::testing::ValuesIn(kBadCases),
                         [](const auto& bad) { return bad.param.name; });

// As in a run whose limit is sought, of joints that soften in others.
TEST(FractureEnergy, IsKeptWhereJointsAreSaidToYield) {
  EXPECT_EQ(message_for(kDome + "joints: {compliance: {per: area}, tension: 1e5, failure: softening, "
                                "fracture_energy: {tension: 10, shear: 10}}\n",
                        {"joints.failure=plastic"}),
            "no error");
}

TEST(SetOption, ErrorsStartWithTheOption) {
  EXPECT_EQ(message_for(kGood, {"joints.friction=-1"}),
            "--set joints.friction=-1: error: joints.friction = -1: must be >= 0");
  EXPECT_EQ(message_for(kGood, {"joints.friction"}),
            "--set joints.friction: error: must be key.path=value, for example joints.friction=0.3");
  EXPECT_EQ(message_for(kGood, {"joints..friction=1"}),
            "--set joints..friction=1: error: the key path has an empty part; write key.path=value");
  EXPECT_EQ(message_for(kGood, {".joints=1"}),
            "--set .joints=1: error: the key path has an empty part; write key.path=value");
  EXPECT_EQ(message_for(kGood, {"friction=1"})
                .find("--set friction=1: error: friction: unknown key; did you mean joints.friction or "),
            0u);
  EXPECT_EQ(message_for(kGood, {"joint.friction=1"})
                .find("--set joint.friction=1: error: joint: unknown key; did you mean joints?"),
            0u);
}

TEST(ExtendsChain, SymbolicLinkOutOfTheFolderIsRefused) {
  const ScratchFolder scratch;
  scratch.write("outside/secret.yaml", kGood);
  std::filesystem::create_directories(scratch.file("case"));
  std::filesystem::create_directory_symlink(scratch.file("outside"), scratch.file("case/link"));
  const std::string path = scratch.write("case/top.yaml", "extends: link/secret.yaml\n");
  EXPECT_THROW(read_case(path), InputError);
}

TEST(ExtendsChain, IsLimitedToSixteenFiles) {
  const ScratchFolder scratch;
  for (int i = 0; i < 40; ++i)
    scratch.write(std::to_string(i) + ".yaml", "extends: " + std::to_string(i + 1) + ".yaml\n");
  try {
    read_case(scratch.file("0.yaml"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 16 files extend one another"), std::string::npos)
        << error.what();
  }
}

// Found by random cases: beside a case in the current folder, an empty name was an empty path.
TEST(MissingFile, AnEmptyNameIsNoFile) {
  EXPECT_THROW(path_inside("", "case.yaml", "", FileLocation{"case.yaml"}), InputError);
}

TEST(MissingFile, IsNamedInTheError) {
  try {
    read_case("no/such/case.yaml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "no/such/case.yaml: error: does not exist");
  }
}

TEST(MissingFile, AFolderIsNamedAsOne) {
  try {
    read_case(".");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), ".: error: is a folder: give the name of a file in it");
  }
}

}  // namespace
}  // namespace cupola::case_error_test
