// How a light field's views are kept: all, some at a time, or not at all; never more than may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/scene/light_field_storage.h"

namespace gazeloop::scene {
namespace {

constexpr std::uint64_t kMib = 1U << 20U;
constexpr std::uint64_t kView = 4 * kMib;  ///< of 1024 x 1024 px

/// An image that takes a little more than its views.
std::uint64_t image_bytes(std::uint32_t layers) { return layers * kView + 4096; }

StorageLimits limits(std::uint64_t most_mib) {
    return {.most_bytes = most_mib * kMib,
            .most_layers = 2048,
            .image_bytes = image_bytes,
            .most_image_bytes = 2048 * kMib};
}

light_field::LightField field(double aperture_m) {
    return {.cameras = {.columns = 25, .rows = 25}, .lens = {.aperture_m = aperture_m}};
}

StoredViews views(bool compressed = false) {
    return {.name = "f",
            .width_px = 1024,
            .height_px = 1024,
            .bytes = compressed ? kView / 8 : kView,
            .compressed = compressed};
}

TEST(LightFieldStorage, KeepsAllViewsWhereTheyFit) {
    const auto all = choose_storage(
        {.cameras = {.columns = 5, .rows = 5}, .lens = {.aperture_m = 1.0}}, views(), limits(101));
    ASSERT_TRUE(all.has_value());
    EXPECT_EQ(all->layers, 25U);
    EXPECT_FALSE(all->streamed);
    const auto less = choose_storage(
        {.cameras = {.columns = 5, .rows = 5}, .lens = {.aperture_m = 0.0}}, views(), limits(100));
    ASSERT_TRUE(less.has_value()) << "the image takes 100 MiB and a page";
    EXPECT_TRUE(less->streamed);
}

// 25 x 25 views of 1024 x 1024, of which no device of 2 GiB holds all.
TEST(LightFieldStorage, StreamsWhatDoesNotFitWithinItsMemory) {
    for (const std::uint64_t most_mib : {400U, 1024U, 2000U, 2600U}) {
        const auto some = choose_storage(field(0.01), views(), limits(most_mib));
        ASSERT_TRUE(some.has_value()) << some.error().message;
        EXPECT_TRUE(some->streamed);
        EXPECT_GE(some->layers, 2 * light_field::most_views(field(0.01)));
        const std::uint64_t taken = image_bytes(some->layers) + some->staged * kView;
        EXPECT_LE(taken, most_mib * kMib);
        EXPECT_LE(image_bytes(some->layers), 2048 * kMib);
        EXPECT_TRUE(image_bytes(some->layers + 1) + some->staged * kView > most_mib * kMib ||
                    image_bytes(some->layers + 1) > 2048 * kMib)
            << "what it may take, it takes";
    }
}

// Two lenses without an opening: the four nearest cameras of each, and no more.
TEST(LightFieldStorage, WithoutAnOpeningTakesEightViews) {
    const auto eight = choose_storage(field(0.0), views(), limits(12 * 4 + 1));
    ASSERT_TRUE(eight.has_value()) << eight.error().message;
    EXPECT_EQ(eight->layers, 8U);
    const auto seven = choose_storage(field(0.0), views(), limits(11 * 4 + 1));
    ASSERT_FALSE(seven.has_value());
    EXPECT_THAT(seven.error().message, testing::HasSubstr("up to 8 of the 625"));
}

// What may be fetched ahead takes the room of no view that a frame can ask for.
TEST(LightFieldStorage, FetchesAheadWhatIsLeftOver) {
    for (const std::uint32_t over : {0U, 1U, 2U, 3U, 7U, 15U, 16U, 100U}) {
        StorageLimits some = limits((8 + 4 + over) * 4 + 1);
        some.most_ahead = 8;
        const auto storage = choose_storage(field(0.0), views(), some);
        ASSERT_TRUE(storage.has_value()) << storage.error().message;
        EXPECT_TRUE(storage->streamed);
        EXPECT_EQ(storage->ahead, std::min(over / 2, 8U));
        EXPECT_EQ(storage->layers, 8 + over - storage->ahead);
        EXPECT_EQ(storage->staged, 4U);
        some.most_ahead = 0;
        EXPECT_EQ(choose_storage(field(0.0), views(), some)->layers, 8 + over);
    }
}

TEST(LightFieldStorage, OfBlocksKeepsAllInAnEighth) {
    StorageLimits eighth = limits(320);
    eighth.image_bytes = [](std::uint32_t layers) { return image_bytes(layers) / 8; };
    const auto all = choose_storage(field(1.0), views(true), eighth);
    ASSERT_TRUE(all.has_value()) << all.error().message;
    EXPECT_EQ(all->layers, 625U);
    EXPECT_FALSE(all->streamed);
}

TEST(LightFieldStorage, RefusesWhatOneFrameNeedsMoreOfAndSaysWhatFits) {
    const auto wide = choose_storage(field(1.0), views(), limits(1024));
    ASSERT_FALSE(wide.has_value());
    const std::string& why = wide.error().message;
    EXPECT_EQ(wide.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(why, testing::HasSubstr("f: two eyes' pictures are made of up to 625 of the 625"));
    EXPECT_THAT(why, testing::HasSubstr("take 2501 MiB"));
    EXPECT_THAT(why, testing::HasSubstr("may take 1024 (lightfield.memory_mib), which holds 251"));
    EXPECT_THAT(why, testing::HasSubstr("lightfield.compression = bc1"));
    // What it says does fit.
    const std::size_t at = why.find("aperture_m = ");
    ASSERT_NE(at, std::string::npos);
    const double narrower_m = std::stod(why.substr(at + 13));
    EXPECT_GT(narrower_m, 0.02);
    EXPECT_TRUE(choose_storage(field(narrower_m), views(), limits(1024)).has_value());
    EXPECT_FALSE(choose_storage(field(narrower_m + 0.0006), views(), limits(1024)).has_value());
    // The views' size that it says fits, too: 649 px.
    const auto px =
        static_cast<std::uint64_t>(std::stod(why.substr(why.find("views of ", at) + 9)));
    StorageLimits smaller = limits(1024);
    smaller.image_bytes = [px](std::uint32_t layers) {
        return std::uint64_t{4} * layers * px * px;
    };
    StoredViews small = views();
    small.bytes = 4 * px * px;
    EXPECT_TRUE(choose_storage(field(1.0), small, smaller).has_value()) << px;
}

TEST(LightFieldStorage, OfBlocksThatStillDoNotFitSaysNothingOfBlocks) {
    const auto none = choose_storage(field(0.0), views(true), limits(1));
    ASSERT_FALSE(none.has_value());
    EXPECT_THAT(none.error().message, testing::Not(testing::HasSubstr("bc1")));
    EXPECT_THAT(none.error().message, testing::Not(testing::HasSubstr("aperture_m")));
}

// To sample every view, as a measurement asks, needs them all.
TEST(LightFieldStorage, OfEveryViewNeedsEveryView) {
    light_field::LightField every = field(0.0);
    every.lens.every_view = true;
    EXPECT_FALSE(choose_storage(every, views(), limits(2000)).has_value());
}

}  // namespace
}  // namespace gazeloop::scene
