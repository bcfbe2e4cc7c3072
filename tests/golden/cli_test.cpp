// The contracts of the command line: exit status, one clear line for what went wrong, JSON keys.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "pictures.h"
#include "program.h"
#include "viewer/image/png.h"

namespace golden_tests {

using nlohmann::json;

TEST(CommandLine, HelpIsThereForTheProgramAndEveryCommand) {
  for (const char* command : {"", "browse", "list", "render", "verify", "compare", "inspect", "measure",
                              "record", "replay", "bench"}) {
    const Outcome o = runVitrine(std::string(command) + " --help");
    EXPECT_EQ(o.status, 0) << command;
    EXPECT_NE(o.out.find("--help"), std::string::npos) << command;
    EXPECT_EQ(o.err, "") << command;
  }
}

struct Mistake {
  std::string arguments;
  std::string says;  // the line on stderr holds this
};

void PrintTo(const Mistake& m, std::ostream* out) { *out << m.arguments; }

// The arguments as an identifier.
std::string mistakeName(const testing::TestParamInfo<Mistake>& info) {
  std::string name;
  for (char c : info.param.arguments) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

class BadUsage : public testing::TestWithParam<Mistake> {};

TEST_P(BadUsage, ExitsWithTwoAndOneLine) {
  const Outcome o = runVitrine(GetParam().arguments);
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.errorLines(), 1) << o.err;
  EXPECT_NE(o.err.find(GetParam().says), std::string::npos) << o.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadUsage,
    testing::Values(
        Mistake{"frobnicate", "unknown command \"frobnicate\""},
        Mistake{"render 2_stabel --out /tmp/x", "did you mean \"2_stable\"?"},
        Mistake{"render stable --out /tmp/x", "did you mean \"2_stable\"?"},
        Mistake{"render 2_stable/towr --out /tmp/x", "did you mean \"2_stable/"},
        Mistake{"render 2_stable", "--out is required"},
        Mistake{"render 2_stable --frames 1,x --out /tmp/x", "\"x\" is not a frame number"},
        Mistake{"render 2_stable --frames 0,-5 --out /tmp/x", "\"-5\" is not a frame number"},
        Mistake{"render 2_stable --frames , --out /tmp/x", "is not a frame number"},
        Mistake{"render 2_stable --frames 0 --size 0x-3 --out /tmp/x", "--size \"0x-3\""},
        Mistake{"render 2_stable --frames 0 --size 100000x100 --out /tmp/x", "--size \"100000x100\""},
        Mistake{"render 2_stable --frames 0 --backend nonsense --out /tmp/x", "unknown backend \"nonsense\""},
        Mistake{"render 2_stable --frames 0 --overlay aabb,foo --out /tmp/x", "\"foo\" is not known"},
        Mistake{"render 2_stable --frames 0 --camera yaw=up --out /tmp/x", "\"up\" is not a number"},
        Mistake{"render 2_stable --frames 0 --out /dev/null/x", "/dev/null/x"},
        Mistake{"measure /nonexistent/none.xml", "/nonexistent/none.xml: no such scene file"},
        Mistake{"measure 2_stable --steps -1", "--steps"}, Mistake{"measure 2_stable --dt nan", "--dt"},
        Mistake{"measure 2_stable --solver magic", "unknown solver \"magic\""},
        Mistake{"compare /nonexistent/a.png /nonexistent/b.png", "/nonexistent/a.png: cannot read"},
        Mistake{"compare /dev/null /dev/null", "/dev/null: not a PNG file"},
        Mistake{"verify --golden /nonexistent", "/nonexistent: no such folder"},
        Mistake{"verify --approve", "--approve needs --reason"},
        Mistake{"verify --shard 4/3", "--shard \"4/3\""},
        Mistake{"verify no_such_sample", "unknown sample or scene \"no_such_sample\""},
        Mistake{"inspect 2_stable --frame 0", "name one, for example 2_stable/"},
        Mistake{"inspect 2_stable/tower --frame 0 --mesh ground", "has no large mesh; this scene has none"},
        Mistake{"inspect 2_stable/tower --frame 0 --mesh nobody", "no body has this name or index"},
        Mistake{"inspect 2_stable/landscape --frame 0 --mesh landscape --triangle 128", "has triangles 0 .. 127"},
        Mistake{"inspect 2_stable/landscape --frame 0 --triangle 1", "--triangle needs --mesh BODY"},
        Mistake{"replay /nonexistent/r.rec", "/nonexistent/r.rec: cannot read"},
        Mistake{"replay /etc/passwd", "/etc/passwd: is not a recording"},
        Mistake{"record 2_stable --steps 5 --out /tmp/x", "name one, for example 2_stable/"},
        Mistake{"bench no_such_case", "unknown case \"no_such_case\"; known: "},
        Mistake{"browse", "vitrine render"}),
    mistakeName);

TEST(CommandLine, ListJsonHasSamplesScenesStagesAndFrames) {
  const json list = json::parse(runVitrine("list --json").out);
  ASSERT_GE(list.size(), 2u);
  for (const auto& sample : list) {
    ASSERT_FALSE(sample.at("scenes").empty());
    for (const auto& scene : sample.at("scenes")) {
      EXPECT_FALSE(scene.at("name").get<std::string>().empty());
      EXPECT_FALSE(scene.at("stages").empty());
      EXPECT_GE(scene.at("frames").size(), 1u);
    }
  }
}

// The first scene of the first sample, for tests that need any.
std::string someScene() {
  const json list = json::parse(runVitrine("list --json").out);
  return list[0]["sample"].get<std::string>() + "/" + list[0]["scenes"][0]["name"].get<std::string>();
}

TEST(CommandLine, MeasureJsonHasItsKeysAndTheSameHashForAnyNumberOfThreads) {
  const std::string call = "measure " + someScene() + " --steps 60 --poses --json --threads ";
  const json one = json::parse(runVitrine(call + "1").out), four = json::parse(runVitrine(call + "4").out);
  for (const char* key : {"target", "steps", "dt", "substeps", "solver", "threads"})
    EXPECT_TRUE(one.contains(key)) << key;
  EXPECT_EQ(one.at("state_hash").get<std::string>().size(), 16u);
  EXPECT_EQ(one.at("state_hash"), four.at("state_hash"));
  EXPECT_EQ(one.at("poses"), four.at("poses"));
  for (const char* key : {"kinetic_energy", "potential_energy", "max_penetration", "max_joint_error",
                          "bodies", "awake", "contacts"})
    EXPECT_TRUE(one.at("final").at(key).is_number()) << key;
  EXPECT_EQ(one.at("final").at("linear_momentum").size(), 3u);
  EXPECT_EQ(one.at("final").at("angular_momentum").size(), 3u);
  for (const char* key : {"max_penetration", "max_joint_error", "speed"})
    EXPECT_TRUE(one.at("max").contains(key)) << key;
  EXPECT_GT(one.at("ms_per_step").at("total").get<double>(), 0.0);
  EXPECT_EQ(one.at("poses").size(), one.at("final").at("bodies").get<size_t>());
  EXPECT_EQ(one.at("poses")[0].at("orientation").size(), 4u);
}

TEST(CommandLine, InspectJsonHasItsKeys) {
  const json facts = json::parse(runVitrine("inspect " + someScene() + " --frame 120 --json").out);
  ASSERT_FALSE(facts.at("islands").empty());
  for (const char* key : {"id", "bodies", "contacts", "joints", "asleep", "sleep_timer"})
    EXPECT_TRUE(facts.at("islands")[0].contains(key)) << key;
  ASSERT_FALSE(facts.at("contacts").empty());
  const json& contact = facts.at("contacts")[0];
  EXPECT_TRUE(contact.contains("body_a") && contact.contains("body_b"));
  for (const char* key : {"position", "normal", "distance", "impulse"})
    EXPECT_TRUE(contact.at("points")[0].contains(key)) << key;
}

TEST(CommandLine, InspectTellsWhichTriangleABallRestsOnAndAllAboutIt) {
  const std::string call = "inspect 2_stable/landscape --frame 300 --json --mesh landscape";
  const json mesh = json::parse(runVitrine(call).out).at("mesh");
  EXPECT_EQ(mesh.at("triangles"), 128);
  int facet = -1;
  for (const json& contact : mesh.at("contacts"))
    if (contact.at("body").at("name") == "sphere") facet = contact.at("triangle").get<int>();
  ASSERT_GE(facet, 0);
  const json triangle = json::parse(runVitrine(call + " --triangle " + std::to_string(facet)).out).at("triangle");
  EXPECT_EQ(triangle.at("triangle"), facet);
  for (const char* key : {"island", "normal", "thickness", "user_data", "quantization_error", "bvh_path"})
    EXPECT_TRUE(triangle.contains(key)) << key;
  EXPECT_EQ(triangle.at("vertices").size(), 3u);
  EXPECT_EQ(triangle.at("edges").size(), 3u);
  ASSERT_FALSE(triangle.at("contacts").empty());
  EXPECT_EQ(triangle.at("contacts")[0].at("body").at("name"), "sphere");
}

TEST(CommandLine, InspectTellsErrorsAndLoadsOfJoints) {
  const json joints = json::parse(runVitrine("inspect 6_joint/basic_joints --frame 30 --joints --json").out).at("joints");
  ASSERT_EQ(joints.size(), 6u);
  for (const json& joint : joints) {
    for (const char* key : {"kind", "body_a", "body_b", "error", "error_angle", "force", "torque"})
      EXPECT_TRUE(joint.contains(key)) << key;
    EXPECT_EQ(joint.at("axes").size(), joint.at("kind") == "swing twist" ? 5u : 6u) << joint.at("kind");
  }
}

TEST(CommandLine, CompareTellsEqualFromDifferent) {
  const ScratchFolder scratch("compare");
  viewer::writePng(scratch / "a.png", drawPicture(Change::None));
  viewer::writePng(scratch / "b.png", drawPicture(Change::DigitChanged));
  viewer::writePng(scratch / "small.png", viewer::Image{1, 1, {0, 0, 0, 255}});
  const auto call = [&](const std::string& a, const std::string& b, const std::string& more) {
    return runVitrine("compare '" + (scratch / a) + "' '" + (scratch / b) + "' " + more);
  };
  Outcome o = call("a.png", "a.png", "--json");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(json::parse(o.out).at("equal"), true);
  EXPECT_EQ(json::parse(o.out).at("verdict"), "pass");

  o = call("a.png", "b.png", "--json --diff '" + (scratch / "d.png") + "'");
  EXPECT_EQ(o.status, 1);
  const json figures = json::parse(o.out);
  EXPECT_EQ(figures.at("verdict"), "fail");
  EXPECT_EQ(figures.at("pixels_over"), 20);
  for (const char* key : {"max_channel", "max_block", "mean_flip"})
    EXPECT_GT(figures.at(key).get<double>(), 0.0) << key;
  EXPECT_EQ(viewer::readPng(scratch / "d.png").width, 640);

  o = call("a.png", "small.png", "");
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("sizes differ"), std::string::npos);
}

TEST(CommandLine, ARecordingIsReproducedAndADivergenceIsFound) {
  const ScratchFolder scratch("record");
  const std::string file = scratch / "run.rec";
  ASSERT_EQ(runVitrine("record " + someScene() + " --steps 30 --out '" + file + "'").status, 0);
  Outcome o = runVitrine("replay '" + file + "'");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("all 31 frames"), std::string::npos) << o.out;
  EXPECT_EQ(runVitrine("replay '" + file + "' --frame 31 --out '" + (scratch / "x.png") + "'").status, 2);
  EXPECT_EQ(runVitrine("replay '" + file + "' --frame 3").status, 2);

  std::vector<uint8_t> bytes = viewer::readFile(file);
  bytes.resize(bytes.size() - 100);
  viewer::writeFile(file, bytes);
  o = runVitrine("replay '" + file + "'");
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.errorLines(), 1) << o.err;
}

}  // namespace golden_tests
