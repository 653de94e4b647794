// Light fields from files, good and bad ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <span>
#include <sstream>

#include "runtime/scene/light_field_file.h"
#include "tests/support/encoded_pictures.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::scene {
namespace {

using testing::HasSubstr;

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
    using Views = std::vector<LightFieldSource::Texels>;
    static Expected<Views> all_of(const LightFieldSource& field,
                                  const LightFieldSource::Prepare& prepare = {}) {
        Views views;
        const auto read =
            field.read(prepare, [&](std::uint32_t view, const LightFieldSource::Texels& texels) {
                EXPECT_EQ(view, views.size());
                views.push_back(texels);
                return Expected<void>{};
            });
        if (!read) {
            return std::unexpected(read.error());
        }
        return views;
    }
    [[nodiscard]] std::string refusal() const {
        const auto field = open_light_field(file());
        if (!field) {
            return field.error().message;
        }
        const auto views = all_of(*field);
        return views ? "" : views.error().message;
    }

    tests::TemporaryFolder folder_;
};

TEST_F(LightFieldFile, GivesTheViewsRowByRow) {
    const auto field = open_light_field(file());
    ASSERT_TRUE(field.has_value()) << field.error().message;
    EXPECT_EQ(field->cameras.columns, 3U);
    EXPECT_EQ(field->cameras.rows, 2U);
    EXPECT_EQ(field->width_px, 4U);
    EXPECT_EQ(field->height_px, 2U);
    const auto views = all_of(*field);
    ASSERT_TRUE(views.has_value()) << views.error().message;
    ASSERT_EQ(views->size(), 6U);
    for (std::size_t view = 0; view < 6; ++view) {
        ASSERT_EQ((*views)[view].size(), 4U * 4 * 2);
        EXPECT_EQ(std::to_integer<int>((*views)[view][0]),
                  static_cast<int>(10 * (view / 3) + view % 3));
    }
}

TEST_F(LightFieldFile, GivesWhatIsMadeOfTheViewsInTheirOrder) {
    const auto field = open_light_field(file());
    ASSERT_TRUE(field.has_value());
    const auto last = all_of(*field, [](const LightFieldSource::Texels& texels) {
        return LightFieldSource::Texels{texels[0], std::byte{7}};
    });
    ASSERT_TRUE(last.has_value());
    EXPECT_EQ(last->at(4), (LightFieldSource::Texels{std::byte{11}, std::byte{7}}));
}

// What takes the views may end the reading: nothing is handed over after that.
TEST_F(LightFieldFile, EndsWhenAViewIsNotTaken) {
    const auto field = open_light_field(file());
    ASSERT_TRUE(field.has_value());
    std::uint32_t taken = 0;
    const auto read = field->read({}, [&](std::uint32_t, const auto&) -> Expected<void> {
        ++taken;
        return std::unexpected(Error{ErrorKind::BadInput, "full"});
    });
    EXPECT_EQ(read.error().message, "full");
    EXPECT_EQ(taken, 1U);
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
    EXPECT_THAT(found, HasSubstr("view_00_02.png: it has 2x4 px, those before it 4x2"));
    EXPECT_THAT(found, HasSubstr("view_01_00.png: "));
    EXPECT_THAT(found, HasSubstr("view_01_01.png: "));
}

// In one message with what is missing: who mends one finds no other afterwards.
TEST_F(LightFieldFile, ListsWhatIsMissingWithWhatIsDamaged) {
    std::filesystem::remove(folder_ / view_file_name(0, 1));
    write(folder_ / view_file_name(0, 0), std::as_bytes(std::span("GIF89a")));
    write(folder_ / view_file_name(1, 0), picture(2, 4, 0));
    const auto whole = picture(4, 2, 7);
    write(folder_ / view_file_name(1, 2), std::span(whole).first(whole.size() / 2));
    const auto field = open_light_field(file());
    ASSERT_FALSE(field.has_value());
    const std::string& found = field.error().message;
    EXPECT_THAT(found, HasSubstr("view_00_01.png is missing"));
    EXPECT_THAT(found, HasSubstr("view_01_00.png: it has 2x4 px, those before it 4x2"));
    EXPECT_THAT(found, HasSubstr("view_01_02.png: "));
    const std::size_t first = found.find("view_00_00.png: ");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(found.find("view_00_00.png: ", first + 1), std::string::npos) << "once";
}

TEST_F(LightFieldFile, OfNothingButDamagedViewsListsThem) {
    for (std::uint32_t view = 0; view < 6; ++view) {
        write(folder_ / view_file_name(view / 3, view % 3), std::as_bytes(std::span("GIF89a")));
    }
    EXPECT_THAT(refusal(),
                testing::AllOf(HasSubstr("view_00_00.png: "), HasSubstr("view_01_02.png: ")));
}

TEST_F(LightFieldFile, RefusesAFileThatIsNone) {
    EXPECT_THAT(open_light_field(folder_ / "b.lightfield").error().message,
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
