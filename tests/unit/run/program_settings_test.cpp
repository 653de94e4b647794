#include "runtime/run/program_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <type_traits>
#include <variant>

#include "runtime/methods/registry.h"
#include "runtime/settings/recorded_values.h"
#include "sim/simulation_settings.h"
#include "tests/support/member_count.h"

namespace gazeloop::run {
namespace {

using settings::Concerns;
using settings::SettingRow;

// Whoever adds a setting thinks here of what a replay is to do with it: see Concerns.
const std::map<Concerns, std::set<std::string>> kConcerns{
    {Concerns::Input,
     {"gaze.calibration", "gaze.calibration_device", "gaze.calibration_values",
      "gaze.fixation_from_depth", "hid.eye_distance_m", "hid.screen_height_m", "hid.screen_width_m",
      "hid.viewing_distance_m", "profile.display", "profile.tracker", "render.scale",
      "steam_frame.file", "steam_frame.rays", "trace.accept_repairs", "trace.axes",
      "trace.longest_gap_s", "virtual_time.gpu_ms"}},
    {Concerns::Foveae,
     {"gaze.after_hold",
      "gaze.blink_hold_ms",
      "gaze.closed_below",
      "gaze.events",
      "gaze.field_deg",
      "gaze.filter",
      "gaze.filter_memory_ms",
      "gaze.fixation_distance_m",
      "gaze.hold_ms",
      "gaze.longest_prediction_ms",
      "gaze.minimum_confidence",
      "gaze.one_euro_hz_per_deg_per_s",
      "gaze.one_euro_least_hz",
      "gaze.prediction",
      "gaze.reopen_ms",
      "gaze.return_ms",
      "gaze.stale_ms",
      "gaze.unplugged_hold_ms",
      "gaze.widen",
      "gaze.widen_by",
      "gaze.widen_error_deg",
      "gaze.widen_head_deg_per_s",
      "gaze.widen_lost_deg_per_s",
      "gaze.widen_most_deg",
      "gaze.widen_noise_deg",
      "gaze.widen_pursuit_deg_per_s",
      "gaze.widen_suppressed",
      "gaze.widen_suppressed_margin_ms"}},
    {Concerns::Picture,
     {"acuity.border_px",
      "acuity.disc",
      "acuity.lp_height",
      "acuity.lp_width",
      "acuity.mar",
      "acuity.pixels_per_degree",
      "fixed.method",
      "governor.levels",
      "governor.use",
      "kfr.alpha",
      "kfr.aspect",
      "kfr.border_px",
      "kfr.close_hole",
      "kfr.disc",
      "kfr.kernel",
      "kfr.kernel_samples",
      "kfr.kernel_table",
      "kfr.lp_height",
      "kfr.lp_width",
      "kfr.polynomial",
      "kfr.sigma",
      "interleaved.disc_every",
      "interleaved.every",
      "interleaved.follow",
      "interleaved.hold",
      "interleaved.jitter",
      "interleaved.refill",
      "interleaved.sharp",
      "interleaved.visits",
      "kfr3d.growth",
      "kfr3d.inner",
      "kfr3d.regions",
      "layers.half_rate",
      "layers.n",
      "layers.outer_weight",
      "layers.s2_fixed",
      "layers.temporal",
      "lightfield.aperture_m",
      "lightfield.compression",
      "lightfield.focus_m",
      "quad.blend",
      "quad.periphery",
      "quad.section",
      "render.camera",
      "render.footprint",
      "render.footprint_taps",
      "render.hidden_area",
      "render.lp_gaussian",
      "render.method",
      "render.post_filter",
      "render.scene",
      "render.specular_filter",
      "render.spp",
      "render.taa",
      "render.taa_reset",
      "rings.inner_deg",
      "rings.outer_deg",
      "rings.tile_px",
      "sparse.accumulate",
      "sparse.depth_guided",
      "sparse.disc_share",
      "sparse.k",
      "sparse.turn",
      "sparse.narrow_share",
      "sparse.narrow_spread",
      "sparse.placement",
      "sparse.share",
      "sparse.wide_spread"}},
    {Concerns::Output,
     {"acuity.luminance_cd_m2", "acuity.nasal", "governor.budget_ms", "governor.budget_share",
      "governor.fit_scale", "governor.floor", "governor.floor_blink", "governor.floor_lost",
      "governor.floor_saccade", "governor.front", "governor.patience_frames",
      "governor.settle_frames", "render.depth", "render.frames_in_flight", "render.profile",
      "render.require", "render.wait_before_latch"}},
    {Concerns::Machine,
     {"layer.blend", "layer.eye_gaze", "layer.foveation", "layer.gaze", "layer.mar",
      "layer.periphery", "layer.quad_views", "layer.record", "layer.unknown_applications",
      "lightfield.memory_mib", "lightfield.prefetch", "monitor.interval_s", "monitor.window_s",
      "openxr.patience_s", "profile.budget", "target.name", "target.validation", "vulkan.device",
      "vulkan.validation"}}};

TEST(ProgramSettings, EachConcernsWhatItShould) {
    const ProgramSettings settings;
    std::set<std::string> keys;
    for (const SettingRow& row : settings.rows()) {
        keys.insert(row.key);
        // Of a simulation a recording holds the gaze that it gave.
        const bool expected = row.key.starts_with("sim.")
                                  ? row.concerns == Concerns::Input
                                  : kConcerns.at(row.concerns).contains(row.key);
        EXPECT_TRUE(expected) << row.key;
    }
    for (const auto& [concerns, known] : kConcerns) {
        for (const std::string& key : known) {
            EXPECT_TRUE(keys.contains(key)) << key;
        }
    }
}

/// Any row of a group is in use under the method of its name, and under no other but these.
TEST(ProgramSettings, OfMethodsAreInUseUnderTheirs) {
    const std::map<std::string, std::vector<std::string>> also{{"acuity.mar", {"layers", "rings"}}};
    const ProgramSettings settings;
    std::set<std::string> groups;
    for (const methods::Method& method : methods::all_methods()) {
        groups.emplace(method.name);
    }
    for (const SettingRow& row : settings.rows()) {
        const std::string group = row.key.substr(0, row.key.find('.'));
        if (group == "gaze" || group == "governor") {
            continue;  // below
        }
        if (group == "lightfield") {
            EXPECT_EQ(row.only_while.key, "") << row.key;  // of scenes that are files
            continue;
        }
        if (row.concerns != Concerns::Picture || group == "render") {
            EXPECT_EQ(row.only_while.key, row.key == "render.taa_reset" ? "render.taa" : "")
                << row.key;
            continue;
        }
        std::vector<std::string> expected{group};
        if (const auto more = also.find(row.key); more != also.end()) {
            expected.insert(expected.end(), more->second.begin(), more->second.end());
        }
        if (group == "kfr") {
            expected.emplace_back("kfr3d");        // whose foveal region it is
            expected.emplace_back("interleaved");  // whose texels these are
        }
        if (group != "fixed") {
            expected.emplace_back("fixed");  // which may stand for any of them
        }
        EXPECT_EQ(row.only_while.key, "render.method") << row.key;
        EXPECT_EQ(row.only_while.values, expected) << row.key;
        for (const std::string& method : row.only_while.values) {
            EXPECT_TRUE(groups.contains(method)) << row.key << ": " << method;
        }
    }
}

TEST(ProgramSettings, OfGazeAreInUseWithTheirFilterOrPrediction) {
    const std::map<std::string, std::pair<std::string, std::string>> only_while{
        {"gaze.filter_memory_ms", {"gaze.filter", "fixation"}},
        {"gaze.longest_prediction_ms", {"gaze.prediction", "true"}},
        {"gaze.one_euro_hz_per_deg_per_s", {"gaze.filter", "one-euro"}},
        {"gaze.one_euro_least_hz", {"gaze.filter", "one-euro"}},
        {"gaze.widen_by", {"gaze.widen", "true"}},
        {"gaze.widen_error_deg", {"gaze.widen", "true"}},
        {"gaze.widen_head_deg_per_s", {"gaze.widen", "true"}},
        {"gaze.widen_lost_deg_per_s", {"gaze.widen", "true"}},
        {"gaze.widen_most_deg", {"gaze.widen", "true"}},
        {"gaze.widen_noise_deg", {"gaze.widen", "true"}},
        {"gaze.widen_pursuit_deg_per_s", {"gaze.widen", "true"}},
        {"gaze.widen_suppressed", {"gaze.widen_by", "events"}},
        {"gaze.widen_suppressed_margin_ms", {"gaze.widen_by", "events"}}};
    const ProgramSettings settings;
    for (const SettingRow& row : settings.rows()) {
        if (!row.key.starts_with("gaze.")) {
            continue;
        }
        const auto expected = only_while.find(row.key);
        if (expected == only_while.end()) {
            EXPECT_EQ(row.only_while.key, "") << row.key;
            continue;
        }
        const auto& [key, value] = expected->second;
        EXPECT_EQ(row.only_while.key, key) << row.key;
        EXPECT_EQ(row.only_while.values, std::vector{value}) << row.key;
    }
}

TEST(ProgramSettings, AreInUseWhileWhatTheyDependOnIs) {
    ProgramSettings settings;
    const auto in_use = [&](std::string_view key) {
        return std::ranges::any_of(settings.rows(), [&](const SettingRow& row) {
            return row.key == key && settings.is_in_use(row);
        });
    };
    ASSERT_TRUE(settings.set("gaze.widen_by", "events", "--set"));
    EXPECT_FALSE(in_use("gaze.widen_by"));
    EXPECT_FALSE(in_use("gaze.widen_suppressed")) << "depends on it in its turn";
    ASSERT_TRUE(settings.set("gaze.widen", "true", "--set"));
    EXPECT_TRUE(in_use("gaze.widen_by"));
    EXPECT_TRUE(in_use("gaze.widen_suppressed"));
}

TEST(ProgramSettings, OfTheGovernorAreInUseWithIt) {
    const ProgramSettings settings;
    for (const SettingRow& row : settings.rows()) {
        if (row.key.starts_with("governor.") && row.key != "governor.use") {
            EXPECT_EQ(row.only_while.key, "governor.use") << row.key;
            EXPECT_THAT(row.only_while.values, testing::ElementsAre("on", "software")) << row.key;
        }
    }
}

TEST(ProgramSettings, GiveEveryMemberARow) {
    const auto expect_all = []<typename Group>(Group group) {
        EXPECT_EQ(rows_of(group).size(), tests::member_count<Group>())
            << rows_of(group).front().key;
    };
    expect_all(gaze::GazeSettings());
    expect_all(governor::GovernorSettings());
    expect_all(drivers::hid::HidSettings());
    expect_all(openxr_layer::LayerSettings());
    expect_all(drivers::steam_frame::SteamFrameSettings());
    expect_all(methods::AcuitySettings());
    expect_all(methods::FixedSettings());
    expect_all(methods::KfrSettings());
    expect_all(methods::Kfr3dSettings());
    expect_all(methods::LayersSettings());
    expect_all(scene::LightFieldSettings());
    expect_all(methods::QuadSettings());
    expect_all(methods::RingsSettings());
    expect_all(methods::SparseSettings());
    expect_all(MonitorSettings());
    expect_all(present::OpenXrSettings());
    expect_all(profiles::ProfileSettings());
    expect_all(TargetSettings());
    expect_all(drivers::TraceSettings());
    expect_all(VirtualTimeSettings());
    expect_all(vulkan::VulkanSettings());
    render::RenderSettings render;
    EXPECT_EQ(render::rows_of(render, {}).size(), tests::member_count<render::RenderSettings>());
    sim::GazeSimulation simulation;
    EXPECT_EQ(sim::rows_of(simulation).size(), 1 + tests::member_count<sim::EyeTerms>() +
                                                   tests::member_count<sim::HeadTerms>() +
                                                   tests::member_count<sim::TrackerTerms>());
}

TEST(ProgramSettings, KeepTheirValuesApart) {
    const ProgramSettings settings;
    std::map<const void*, std::string> owners;
    for (const SettingRow& row : settings.rows()) {
        const void* const value = std::visit(
            []<typename Slot>(const Slot& slot) -> const void* {
                if constexpr (std::is_pointer_v<Slot>) {
                    return slot;
                } else {
                    return slot.value;
                }
            },
            row.slot);
        const auto [owner, is_new] = owners.emplace(value, row.key);
        EXPECT_TRUE(is_new) << row.key << " and " << owner->second;
    }
}

TEST(ProgramSettings, TakeAnySeed) {
    ProgramSettings settings;
    EXPECT_TRUE(settings.set("sim.seed", "18446744073709551615", "--seed").has_value());
    EXPECT_EQ(settings.values().sim.seed, ~std::uint64_t{0});
    for (const char* text : {"-1", "18446744073709551616", "1.5", "", "x"}) {
        EXPECT_FALSE(settings.set("sim.seed", text, "--seed").has_value()) << text;
    }
    EXPECT_FALSE(settings.set("sim.rate_hz", "nan", "--set").has_value());
    EXPECT_FALSE(settings.set("sim.rate_hz", "0.5", "--set").has_value());
    EXPECT_TRUE(settings.set("sim.rate_hz", "10000", "--set").has_value());
    EXPECT_FALSE(settings.set("sim.noise_deg", "91", "--set").has_value());
}

TEST(ProgramSettings, SayWhichTwoDoNotFit) {
    ProgramSettings jump;
    ASSERT_TRUE(jump.set("gaze.hold_ms", "50", "--set").has_value());
    const auto fovea = jump.check();
    ASSERT_FALSE(fovea.has_value());
    EXPECT_THAT(fovea.error().message,
                testing::StartsWith(
                    "gaze.hold_ms = 50 (--set): is less than gaze.stale_ms = 100 (built-in): "));
    ProgramSettings idle;
    ASSERT_TRUE(idle.set("kfr.polynomial", "1", "--set").has_value());
    const auto kernel = idle.check();
    ASSERT_FALSE(kernel.has_value());
    EXPECT_THAT(kernel.error().message,
                testing::StartsWith("kfr.polynomial = 1 (--set): has no effect while "
                                    "kfr.kernel = power (built-in): "));
    EXPECT_TRUE(ProgramSettings().check().has_value());
}

/// What a recording by a method says of pictures when a setting is another now.
bool same_picture(const std::string& method, const std::string& key, const std::string& value) {
    methods::MethodSettings values;
    render::RenderSettings render;
    settings::Settings settings;
    settings.add(rows_of(values));
    settings.add(render::rows_of(render, {}));
    EXPECT_TRUE(settings.set("render.method", method, "test").has_value());
    const std::vector<NamedValue> recorded = settings.list();
    EXPECT_TRUE(settings.set(key, value, "test").has_value());
    return settings::are_as_recorded(recorded, Concerns::Picture, settings);
}

TEST(ProgramSettings, OfAMethodDecideItsPicturesAlone) {
    EXPECT_FALSE(same_picture("kfr", "kfr.sigma", "3"));
    EXPECT_FALSE(same_picture("layers", "layers.n", "2"));
    EXPECT_FALSE(same_picture("rings", "rings.tile_px", "8"));
    EXPECT_FALSE(same_picture("sparse", "sparse.share", "0.2"));
    for (const char* method : {"acuity", "layers", "rings"}) {
        EXPECT_FALSE(same_picture(method, "acuity.mar", "0.03")) << method;
    }
    EXPECT_TRUE(same_picture("kfr", "acuity.mar", "0.03"));
    EXPECT_TRUE(same_picture("full", "kfr.sigma", "3"));
    EXPECT_TRUE(same_picture("kfr", "layers.n", "2"));
    EXPECT_FALSE(same_picture("quad", "quad.section", "0.5"));
    EXPECT_FALSE(same_picture("fixed", "fixed.method", "rings"));
    EXPECT_FALSE(same_picture("fixed", "kfr.sigma", "3"));
    EXPECT_TRUE(same_picture("quad", "fixed.method", "rings"));
    EXPECT_TRUE(same_picture("acuity", "acuity.nasal", "true"));
}

}  // namespace
}  // namespace gazeloop::run
