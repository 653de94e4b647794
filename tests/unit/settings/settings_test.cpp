#include "runtime/settings/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/settings/recorded_values.h"
#include "tests/support/run_program.h"

namespace gazeloop::settings {
namespace {

using testing::HasSubstr;

/// One setting of each kind, and of each concern.
class SettingsOfAll : public testing::Test {
  protected:
    SettingsOfAll() {
        settings_.add({
            {"one.way", "how",
             Choice{.value = &way_,
                    .names = {"plain", "fine"},
                    .what = {},
                    .file_extensions = {".way", ".w"}},
             Concerns::Picture},
            {"one.grain",
             "how fine",
             Number{&grain_, 0.0, 2.0},
             Concerns::Picture,
             {"one.way", {"fine"}}},
            {"one.hold", "how long", Whole{&hold_, 0, 9}, Concerns::Foveae},
        });
        settings_.add({
            {"two.seed", "of all", Seed{&seed_}, Concerns::Input},
            {"two.weights", "of all", NumberList{&weights_}, Concerns::Output},
            {"two.loud", "say more", &loud_, Concerns::Machine},
            {"two.file", "where it is", Path{&file_, ".toml"}, Concerns::Machine},
        });
    }

    [[nodiscard]] bool same(Concerns what) const {
        return are_as_recorded(recorded_, what, settings_);
    }

    std::string way_ = "plain";
    double grain_ = 1.0;
    std::int64_t hold_ = 3;
    std::uint64_t seed_ = 1;
    std::string weights_ = "1";
    bool loud_ = false;
    std::string file_ = "name";
    Settings settings_;
    std::vector<NamedValue> recorded_;
};

TEST_F(SettingsOfAll, AChoiceMayBeAFileWhereItSaysSo) {
    ASSERT_TRUE(settings_.set("one.way", "folder/my.w", "--set"));
    EXPECT_EQ(way_, "folder/my.w");
    EXPECT_EQ(settings_.origin("one.way"), "--set");
    for (const char* text : {".w", "my.wa", "my.w.txt", "plan"}) {
        const auto set = settings_.set("one.way", text, "--set");
        ASSERT_FALSE(set) << text;
        EXPECT_EQ(set.error().kind, ErrorKind::Usage);
    }
    // In a file, it lies beside that.
    const tests::ScratchFolder folder;
    const std::filesystem::path file = folder.write("c.toml", "[one]\nway = \"my.way\"\n");
    ASSERT_TRUE(settings_.load(file));
    EXPECT_EQ(way_, (file.parent_path() / "my.way").string());
}

TEST_F(SettingsOfAll, AreListedByKeyWhoeverAddedThem) {
    std::vector<std::string> keys;
    for (const NamedValue& setting : settings_.list()) {
        keys.push_back(setting.name + "=" + setting.value);
    }
    EXPECT_THAT(keys,
                testing::ElementsAre("one.grain=1", "one.hold=3", "one.way=plain", "two.file=name",
                                     "two.loud=false", "two.seed=1", "two.weights=1"));
}

TEST_F(SettingsOfAll, PutValuesWhereTheyBelong) {
    EXPECT_TRUE(settings_.set("one.grain", "0.5", "--set").has_value());
    EXPECT_EQ(grain_, 0.5);
    EXPECT_EQ(settings_.with_origin("one.grain"), "one.grain = 0.5 (--set)");
    EXPECT_FALSE(settings_.is_built_in("one.grain"));
    EXPECT_FALSE(settings_.set("one.grain", "2.5", "--set").has_value());
    EXPECT_FALSE(settings_.set("one.hold", "1.5", "--set").has_value());
    EXPECT_FALSE(settings_.set("two.loud", "yes", "--set").has_value());
    EXPECT_TRUE(settings_.set_default("one.grain", "0.75", "profile").has_value());
    EXPECT_EQ(grain_, 0.5);
}

TEST_F(SettingsOfAll, SayWhatIsWrong) {
    const auto unknown = settings_.set("one.grian", "1", "--set");
    EXPECT_EQ(unknown.error().message,
              "--set: unknown key 'one.grian'; did you mean 'one.grain'?; known: one.grain, "
              "one.hold, one.way");
    EXPECT_EQ(
        settings_.set("one.way", "fien", "--set").error().message,
        "--set: unknown way 'fien'; did you mean 'fine'?; known: plain, fine; or a file whose "
        "name ends in .way, .w");
}

// Only a list of numbers may be written as one in TOML.
TEST_F(SettingsOfAll, TakeNumbersFromAnArray) {
    const tests::ScratchFolder folder;
    ASSERT_TRUE(settings_.load(folder.write("a.toml", "[two]\nweights = [0.25, 0.75]\n")));
    EXPECT_EQ(weights_, "0.25,0.75");
    const auto other = settings_.load(folder.write("b.toml", "[one]\nway = [1]\n"));
    ASSERT_FALSE(other.has_value());
    EXPECT_THAT(other.error().message, HasSubstr("b.toml:2: one.way: one value is expected"));
}

TEST_F(SettingsOfAll, TakeFromARecordingAllButTheMachines) {
    const std::vector<NamedValue> recorded{
        {"one.hold", "4"}, {"two.file", "theirs"}, {"two.loud", "true"}, {"two.weights", "2"}};
    ASSERT_TRUE(take_recorded(recorded, "old.gaze", settings_).has_value());
    EXPECT_EQ(hold_, 4);
    EXPECT_EQ(weights_, "2");
    EXPECT_EQ(file_, "name");
    EXPECT_FALSE(loud_);
    EXPECT_EQ(settings_.origin("one.hold"), "old.gaze");
    const std::vector<NamedValue> newer{{"one.held", "4"}};
    EXPECT_THAT(take_recorded(newer, "new.gaze", settings_).error().message,
                HasSubstr("new.gaze: unknown key 'one.held'"));
}

TEST_F(SettingsOfAll, AreAsRecordedInWhatTheyConcern) {
    recorded_ = settings_.list();
    for (const Concerns what : {Concerns::Input, Concerns::Foveae, Concerns::Picture,
                                Concerns::Output, Concerns::Machine}) {
        EXPECT_TRUE(same(what));
    }
    hold_ = 5;
    EXPECT_FALSE(same(Concerns::Foveae));
    EXPECT_TRUE(same(Concerns::Picture));
    loud_ = true;
    weights_ = "3";
    EXPECT_FALSE(same(Concerns::Machine));
    EXPECT_FALSE(same(Concerns::Output));
    EXPECT_TRUE(same(Concerns::Input));
}

TEST_F(SettingsOfAll, CountOnlyWhileTheyAreInUse) {
    recorded_ = settings_.list();
    grain_ = 0.25;
    EXPECT_TRUE(same(Concerns::Picture));
    way_ = "fine";
    EXPECT_FALSE(same(Concerns::Picture));
    recorded_ = settings_.list();
    EXPECT_TRUE(same(Concerns::Picture));
    grain_ = 0.5;
    EXPECT_FALSE(same(Concerns::Picture));
}

// The program that recorded it had none like it, and did what the built-in value stands for.
TEST_F(SettingsOfAll, ThatARecordingDoesNotListAreAsRecordedWhileTheyAreBuiltIn) {
    recorded_ = settings_.list();
    std::erase_if(recorded_, [](const NamedValue& one) { return one.name == "one.hold"; });
    EXPECT_TRUE(same(Concerns::Foveae));
    ASSERT_TRUE(settings_.set("one.hold", "4", "--set").has_value());
    EXPECT_FALSE(same(Concerns::Foveae));
    EXPECT_TRUE(same(Concerns::Picture));
}

}  // namespace
}  // namespace gazeloop::settings
