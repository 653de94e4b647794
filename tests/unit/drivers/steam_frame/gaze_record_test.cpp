#include "drivers/steam_frame/gaze_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "sim/steam_frame_file.h"

namespace gazeloop::drivers::steam_frame {
namespace {

template <typename T>
void put(Image& image, std::size_t at, T value) {
    std::memcpy(image.data() + at, &value, sizeof value);
}

// By the offsets that the tools state, written out by hand.
TEST(SteamFrameRecord, IsReadWhereTheToolsReadIt) {
    for (const auto& [version, record] :
         {std::pair<std::uint32_t, std::size_t>{4, 0x152}, {5, 0x157}}) {
        Image image{};
        put(image, 0x00, version);
        put(image, 0x04, 1U);
        put(image, 0x38, 0xFFFFFFFEU);
        put(image, record + 0x05, 1234.5);
        for (std::size_t i = 0; i < 29; ++i) {
            put(image, record + 0x0d + 4 * i, static_cast<float>(i + 1));
        }
        const Header header = decode_header(image);
        EXPECT_EQ(header.version, version);
        EXPECT_TRUE(header.initialised);
        EXPECT_EQ(header.counter, 0xFFFFFFFEU);
        const auto layout = layout_of(header);
        ASSERT_TRUE(layout.has_value());
        EXPECT_EQ(layout->record_at, record);
        const GazeRecord gaze = decode_record(record_in(image, *layout));
        EXPECT_EQ(gaze.time_s, 1234.5);
        EXPECT_EQ(gaze.filtered[0].direction, (glm::dvec3{1.0, 2.0, 3.0}));
        EXPECT_EQ(gaze.filtered[1].direction, (glm::dvec3{4.0, 5.0, 6.0}));
        EXPECT_EQ(gaze.filtered[0].variances, (glm::dvec3{7.0, 8.0, 9.0}));
        EXPECT_EQ(gaze.filtered[1].variances, (glm::dvec3{10.0, 11.0, 12.0}));
        EXPECT_EQ(gaze.fixation_m, (glm::dvec3{13.0, 14.0, 15.0}));
        EXPECT_EQ(gaze.before_fusion[0].direction, (glm::dvec3{16.0, 17.0, 18.0}));
        EXPECT_EQ(gaze.before_fusion[1].direction, (glm::dvec3{19.0, 20.0, 21.0}));
        EXPECT_EQ(gaze.before_fusion[0].variances, (glm::dvec3{22.0, 23.0, 24.0}));
        EXPECT_EQ(gaze.before_fusion[1].variances, (glm::dvec3{25.0, 26.0, 27.0}));
        EXPECT_EQ(gaze.openness[0], 28.0);
        EXPECT_EQ(gaze.openness[1], 29.0);
    }
}

TEST(SteamFrameRecord, OfAnUnknownVersionIsNotGuessedAt) {
    for (const std::uint32_t version : {0U, 3U, 6U, 0xFFFFFFFFU}) {
        const auto layout = layout_of({.version = version, .initialised = true, .counter = 7});
        ASSERT_FALSE(layout.has_value());
        EXPECT_EQ(layout.error().kind, ErrorKind::NoDevice);
        for (const std::string& part :
             {"version " + std::to_string(version) + " of", std::string("4 (build 20260921)"),
              std::string("5 (build 20260930)"), std::string("not guessed")}) {
            EXPECT_NE(layout.error().message.find(part), std::string::npos)
                << layout.error().message;
        }
    }
    const auto early = layout_of({.version = 5, .initialised = false, .counter = 0});
    ASSERT_FALSE(early.has_value());
    EXPECT_NE(early.error().message.find("not initialised"), std::string::npos);
}

TEST(SteamFrameRecord, OfTheSimulationIsReadBack) {
    sim::SteamFrameGaze gaze{.time_s = 5e5 + 1.0 / 3.0,
                             .filtered = {},
                             .before_fusion = {},
                             .fixation_m = {.1F, -.2F, -1.5F},
                             .openness = {.25F, .875F}};
    gaze.filtered[0] = {{.5F, .25F, -.75F}, {1e-5F, 2e-5F, 3e-5F}};
    gaze.before_fusion[1] = {{-.5F, .125F, -.5F}, {4e-5F, 5e-5F, 6e-5F}};
    const sim::SteamFrameRecord bytes = sim::steam_frame_record(gaze);
    const GazeRecord read = decode_record(bytes);
    EXPECT_EQ(read.time_s, gaze.time_s);
    EXPECT_EQ(read.filtered[0].direction, glm::dvec3(gaze.filtered[0].direction));
    EXPECT_EQ(read.filtered[0].variances, glm::dvec3(gaze.filtered[0].variances));
    EXPECT_EQ(read.filtered[1].direction, glm::dvec3(0.0));
    EXPECT_EQ(read.before_fusion[1].direction, glm::dvec3(gaze.before_fusion[1].direction));
    EXPECT_EQ(read.before_fusion[1].variances, glm::dvec3(gaze.before_fusion[1].variances));
    EXPECT_EQ(read.fixation_m, glm::dvec3(gaze.fixation_m));
    EXPECT_EQ(read.openness[0], .25);
    EXPECT_EQ(read.openness[1], .875);
}

}  // namespace
}  // namespace gazeloop::drivers::steam_frame
