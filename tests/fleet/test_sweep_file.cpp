// Sweep files: what they ask for, and one line that names the place for each mistake.
#include "fleet/sweep_file.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "fleet/nearest_name.h"
#include "temp_folder.h"

namespace hl::test_sweep_file {
namespace {

// As of a trace with three options: radius above 0; grip light or firm, which needs tremor.
SweepRules rules() {
  SweepRules rules;
  rules.names = {"radius", "grip", "tremor", "static-friction"};
  rules.most_seed = 1000;
  rules.fault = [](const SweepOptions& options) -> std::string {
    bool grip = false, tremor = false;
    for (const SweepOption& option : options) {
      if (option.name == "radius" && option.value.starts_with('-'))
        return "--radius: '" + option.value + "' is too small";
      if (option.name == "grip" && option.value != "light" && option.value != "firm")
        return "--grip: no " + option.value;
      grip = grip || option.name == "grip";
      tremor = tremor || option.name == "tremor";
    }
    return grip && !tremor ? "--grip requires --tremor" : "";
  };
  return rules;
}

SweepFile read(const std::string& text) { return readSweepFile(test::fileWith("sweep.toml", text), rules()); }

// Without the name of the file.
std::string faultOf(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos);
    EXPECT_TRUE(what.starts_with(test::tempFile("sweep.toml") + ":")) << what;
    return what.substr(test::tempFile("sweep.toml").size() + 1);
  }
  return "none";
}

const std::string kSources = "scenes = \"teapot\"\npaths = [\"a.csv\", \"b.csv\"]\n";

std::string optionsOf(const SweepFile& sweep) {
  std::string text;
  for (const SweepOptions& options : sweep.options) {
    for (const SweepOption& option : options) text += option.name + "=" + option.value + " ";
    text += "| ";
  }
  return text;
}

TEST(SweepFiles, SayScenesPathsOptionsAndSeeds) {
  const SweepFile sweep = read(kSources + "seeds = [3, 1]\nrows = true\n[options]\ntremor = 1e-3\nradius = 2\n");
  EXPECT_EQ(sweep.scenes, (std::vector<std::string>{"teapot"}));
  EXPECT_EQ(sweep.paths, (std::vector<std::string>{"a.csv", "b.csv"}));
  EXPECT_EQ(sweep.seeds, (std::vector<std::int64_t>{3, 1}));
  EXPECT_TRUE(sweep.rows);
  EXPECT_EQ(optionsOf(sweep), "radius=2 tremor=0.001 | ");
}

TEST(SweepFiles, NeedNoMoreThanASceneAndAPath) {
  const SweepFile sweep = read(kSources);
  EXPECT_EQ(sweep.options, std::vector<SweepOptions>(1));
  EXPECT_TRUE(sweep.seeds.empty());
  EXPECT_FALSE(sweep.rows);
}

TEST(SweepFiles, TakeEveryValueOfAnOptionWithEveryOneOfTheOthers) {
  EXPECT_EQ(optionsOf(read(kSources + "[options]\ntremor = [0.5, 1]\nradius = [1, 2]\n")),
            "radius=1 tremor=0.5 | radius=1 tremor=1 | radius=2 tremor=0.5 | radius=2 tremor=1 | ");
  EXPECT_EQ(optionsOf(read(kSources + "[[options]]\nradius = 1\n[[options]]\ntremor = 1\ngrip = ['light', 'firm']\n")),
            "radius=1 | grip=light tremor=1 | grip=firm tremor=1 | ");
}

TEST(SweepFiles, KeepTheOrderOfKeysOutOfTheResult) {
  EXPECT_EQ(optionsOf(read(kSources + "[options]\ntremor = 1\nradius = 1\n")),
            optionsOf(read(kSources + "[options]\nradius = 1\ntremor = 1\n")));
}

TEST(SweepFiles, KeepEveryDigitOfANumber) {
  EXPECT_EQ(optionsOf(read(kSources + "[options]\nradius = 0.1000000000000000055511151231257827\n")), "radius=0.1 | ");
  EXPECT_EQ(optionsOf(read(kSources + "[options]\nradius = 0.30000000000000004\n")), "radius=0.30000000000000004 | ");
}

TEST(SweepFiles, CountSeedsFromTheFirst) {
  EXPECT_EQ(read(kSources + "seeds = {first = 5, count = 3}\n[options]\ntremor = 1\n").seeds,
            (std::vector<std::int64_t>{5, 6, 7}));
}

TEST(SweepFiles, ReportTheLineOfAMistake) {
  struct Case {
    std::string text, fault;
  };
  for (const Case& c : {
           Case{"scenes = [\n\"a\"\n", "this is not TOML"},
           Case{"scenes = \"a\"\nscenes = \"b\"\n", "2: this is not TOML"},
           Case{"paths = \"a\"\n", "1: there are no scenes"},
           Case{"scenes = \"a\"\n", "1: there are no paths"},
           Case{"scenes = []\npaths = \"a\"\n", "1: there are no scenes in the list"},
           Case{"scenes = [\n\"a\",\n3]\npaths = \"a\"\n", "3: scenes must be texts"},
           Case{"scenes = [\n\"a\",\n\"a\"]\npaths = \"a\"\n", "3: 'a' is there twice"},
           Case{kSources + "rows = 1\n", "3: rows must be true or false"},
           Case{kSources + "\nscens = 1\n", "4: there is no 'scens': is 'scenes' meant?"},
           Case{kSources + "weather = 1\n", "3: there is no 'weather'; there are scenes, paths"},
           Case{kSources + "[options]\n\nraduis = 1\n", "5: there is no 'raduis' in options: is 'radius' meant?"},
           Case{kSources + "[options]\nstatic_friction = 1\n",
                "4: there is no 'static_friction' in options: is 'static-friction' meant?"},
           Case{kSources + "[options]\nseed = 1\n", "4: seeds are a list of their own"},
           Case{kSources + "[options]\nradius = [1,\n2,\n-3]\n", "6: --radius: '-3' is too small"},
           Case{kSources + "[options]\ntremor = 1\nradius = -3\n", "5: --radius: '-3' is too small"},
           Case{kSources + "[options]\nradius = 1\ngrip = \"light\"\n", "5: --grip requires --tremor"},
           Case{kSources + "[options]\nradius = []\n", "4: radius has no value"},
           Case{kSources + "[options]\nradius = [1, 1]\n", "4: radius has the value 1 twice"},
           Case{kSources + "[options]\nradius = 1979-05-27\n", "4: radius must be a number"},
           Case{kSources + "options = 3\n", "3: options must be a table"},
           Case{kSources + "options = []\n", "3: there are no options"},
           Case{kSources + "seeds = [1]\n", "3: without tremor in options every seed gives the same"},
           Case{kSources + "seeds = [1.5]\n", "3: seeds are whole numbers"},
           Case{kSources + "seeds = []\n", "3: there are no seeds"},
           Case{kSources + "seeds = [1,\n1]\n", "4: the seed 1 is there twice"},
           Case{kSources + "seeds = [-1]\n", "3: a seed is from 0 to 1000"},
           Case{kSources + "seeds = {first = 9223372036854775807, count = 2}\n", "3: a seed is from 0 to 1000"},
           Case{kSources + "seeds = {first = 1}\n", "3: seeds need count"},
           Case{kSources + "seeds = {first = 1, cuont = 2}\n", "3: there is no 'cuont' in seeds: is 'count' meant?"},
           Case{kSources + "seeds = {first = 1, count = 0}\n", "3: the count of seeds is from 1"},
       })
    EXPECT_NE(faultOf(c.text).find(c.fault), std::string::npos) << c.text << "\n" << faultOf(c.text);
}

TEST(SweepFiles, RefuseMoreTasksThanAnyoneMeans) {
  std::string many = "[";
  for (int i = 0; i < 3000; ++i) many += std::to_string(i) + ",";
  many += "]\n";
  EXPECT_NE(faultOf(kSources + "[options]\nradius = " + many + "tremor = " + many + "static-friction = " + many)
                .find("more than 1000000 tasks"),
            std::string::npos);
}

TEST(SweepFiles, ThatAreNotThereAreAnError) { EXPECT_THROW(readSweepFile("/nonexistent.toml", rules()), Error); }

TEST(NearestName, IsTheOneWithTheFewestChanges) {
  const std::vector<std::string> names{"scenes", "paths", "seeds", "stiffness"};
  EXPECT_EQ(nearestName("seed", names), "seeds");
  EXPECT_EQ(nearestName("stifness", names), "stiffness");
  EXPECT_EQ(nearestName("sceens", names), "scenes");
  EXPECT_EQ(nearestName("PATHS", names), "");
  EXPECT_EQ(nearestName("", names), "");
  EXPECT_EQ(nearestName(std::string(10'000, 's'), names), "");
}

}  // namespace
}  // namespace hl::test_sweep_file
