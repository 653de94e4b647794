// Light fields from files, good and bad ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "runtime/scene/light_field_file.h"
#include "tests/support/encoded_pictures.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::scene {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kEnough = 1 << 20;

void write(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

std::vector<std::byte> picture(int width, int height, std::uint8_t grey) {
    const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * width * height), grey);
    const auto bytes = tests::encoded_png(width, height, PNG_FORMAT_RGB, pixels.data());
    return {bytes.begin(), bytes.end()};
}

/// Two rows of three views of 4 x 2 px, each of a grey of its own.
class LightFieldFile : public testing::Test {
  protected:
    LightFieldFile() {
        std::ofstream(file()) << light_field_text({.columns = 3, .rows = 2});
        for (std::uint32_t row = 0; row < 2; ++row) {
            for (std::uint32_t column = 0; column < 3; ++column) {
                write(folder_ / view_file_name(row, column),
                      picture(4, 2, static_cast<std::uint8_t>(10 * row + column)));
            }
        }
    }
    [[nodiscard]] std::filesystem::path file() const { return folder_ / "a.lightfield"; }
    [[nodiscard]] std::string refusal(std::uint64_t most_bytes = kEnough) const {
        const auto loaded = load_light_field(file(), most_bytes);
        return loaded ? "" : loaded.error().message;
    }

    tests::TemporaryFolder folder_;
};

TEST_F(LightFieldFile, GivesTheViewsRowByRow) {
    const auto loaded = load_light_field(file(), kEnough);
    ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
    EXPECT_EQ(loaded->cameras.columns, 3U);
    EXPECT_EQ(loaded->cameras.rows, 2U);
    EXPECT_EQ(loaded->width_px, 4U);
    EXPECT_EQ(loaded->height_px, 2U);
    ASSERT_EQ(loaded->views.size(), 6U);
    for (std::size_t view = 0; view < 6; ++view) {
        ASSERT_EQ(loaded->views[view].size(), 4U * 4 * 2);
        EXPECT_EQ(std::to_integer<int>(loaded->views[view][0]),
                  static_cast<int>(10 * (view / 3) + view % 3));
    }
}

TEST_F(LightFieldFile, KnowsViewsByRowAndColumnHoweverTheyAreNamed) {
    std::filesystem::rename(folder_ / view_file_name(1, 2), folder_ / "out-1-2.PNG");
    std::ofstream(folder_ / "README.txt") << "no picture";
    EXPECT_EQ(refusal(), "");
}

TEST_F(LightFieldFile, ListsAllThatIsWrongWithTheViews) {
    std::filesystem::remove(folder_ / view_file_name(0, 1));
    write(folder_ / "cover.png", picture(4, 2, 0));
    write(folder_ / "view_02_00.png", picture(4, 2, 0));
    write(folder_ / "again_1_1.png", picture(4, 2, 0));
    const std::string found = refusal();
    EXPECT_THAT(found, HasSubstr("view_00_01.png is missing"));
    EXPECT_THAT(found, HasSubstr("cover.png does not end in row and column"));
    EXPECT_THAT(found, HasSubstr("view_02_00.png is beyond the 2 rows and 3 columns"));
    EXPECT_THAT(found, HasSubstr("again_1_1.png and view_01_01.png are of one place"));
}

TEST_F(LightFieldFile, ListsViewsOfAnotherSizeAndDamagedOnes) {
    write(folder_ / view_file_name(0, 2), picture(2, 4, 0));
    const auto whole = picture(4, 2, 7);
    write(folder_ / view_file_name(1, 0), std::span(whole).first(whole.size() / 2));
    write(folder_ / view_file_name(1, 1), std::as_bytes(std::span("GIF89a")));
    const std::string found = refusal();
    EXPECT_THAT(found, HasSubstr("view_00_02.png has 2x4 px, those before it 4x2"));
    EXPECT_THAT(found, HasSubstr("view_01_00.png: "));
    EXPECT_THAT(found, HasSubstr("view_01_01.png: "));
}

TEST_F(LightFieldFile, RefusesMoreThanMayBeTakenAndSaysWhatFits) {
    constexpr std::uint64_t kAllViews_bytes = std::uint64_t{6} * 4 * 2 * 4;
    EXPECT_EQ(refusal(kAllViews_bytes), "");
    EXPECT_THAT(refusal(kAllViews_bytes - 1), HasSubstr("5 views, or views of 3 px across"));
}

TEST_F(LightFieldFile, RefusesAFileThatIsNone) {
    EXPECT_THAT(load_light_field(folder_ / "b.lightfield", kEnough).error().message,
                HasSubstr("b.lightfield: the light field cannot be read"));
    for (const auto& [text, why] :
         {std::pair{"columns = ", ":1: "},
          {"columns = 3", ": rows = NUMBER is expected"},
          {"colums = 3", ":1: there is no key 'colums'"},
          {"columns = 3.5\nrows = 2\nspacing_m = 1\nhorizontal_deg = 90\nvertical_deg = 90",
           "whole numbers"},
          {"columns = 3\nrows = 2\nspacing_m = 1\nhorizontal_deg = 180\nvertical_deg = 90",
           "between 0 and 180"},
          {"columns = 0\nrows = 2\nspacing_m = 1\nhorizontal_deg = 90\nvertical_deg = 90",
           "columns = 0: must lie in [1, 64]"},
          {"columns = 3\nrows = 2\nspacing_m = nan\nhorizontal_deg = 90\nvertical_deg = 90",
           "spacing_m"}}) {
        std::istringstream in(text);
        const auto read = read_light_field(in, "x");
        ASSERT_FALSE(read.has_value()) << text;
        EXPECT_THAT(read.error().message, HasSubstr(why));
    }
}

TEST(LightFieldText, IsReadAgain) {
    const light_field::CameraGrid grid{
        .columns = 25, .rows = 7, .spacing_m = 0.0031, .half_tangents = {1.19, 0.7}};
    std::istringstream in(light_field_text(grid));
    const auto again = read_light_field(in, "x");
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->columns, grid.columns);
    EXPECT_EQ(again->rows, grid.rows);
    EXPECT_EQ(again->spacing_m, grid.spacing_m);
    EXPECT_NEAR(again->half_tangents.x, grid.half_tangents.x, 1e-12);
    EXPECT_NEAR(again->half_tangents.y, grid.half_tangents.y, 1e-12);
}

}  // namespace
}  // namespace gazeloop::scene
