// A video as files: what is read, and what is refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/probe/frame_files.h"
#include "runtime/probe/frame_picture.h"
#include "runtime/probe/video_result.h"
#include "tests/support/camera_video.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

probe::VideoQuestion question(const fs::path& folder, double fps) {
    return {.frames = folder,
            .camera_fps = fps,
            .lamp = *probe::parse_region("lamp", FrameWriter::kLamp),
            .patch = *probe::parse_region("patch", FrameWriter::kPatch)};
}

std::string refusal(const fs::path& folder) {
    const auto result = probe::measure_video(question(folder, 240));
    EXPECT_FALSE(result.has_value());
    return result ? "" : result.error().message;
}

/// Frames 1 to 9, dark.
void write_dark(const fs::path& folder) {
    FrameWriter writer(FrameFormat::Grey8);
    for (int frame = 1; frame <= 9; ++frame) {
        writer.write(folder / fmt::format("f{}.png", frame), 0.1, 0.1);
    }
}

class VideoFormats : public testing::TestWithParam<std::pair<FrameFormat, double>> {};

TEST_P(VideoFormats, AreMeasuredToHalfACameraFrame) {
    const auto& [format, fps] = GetParam();
    const TemporaryFolder folder;
    const LampAndDisplay set_up;
    sim::Random random(7, sim::Stream::Targets);
    const Truth truth = switch_lamp(set_up, 20, random);
    const std::size_t frames =
        film(folder.path(), format, {.fps = fps, .noise = 0.01, .flicker = 0.02}, set_up, truth, 7);
    const auto result = probe::measure_video(question(folder.path(), fps));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_EQ(result->frames, frames);
    ASSERT_EQ(result->on.trials, 20U);
    ASSERT_EQ(result->off.trials, 20U);
    EXPECT_NEAR(*result->on.mean_ms, truth.mean_ms(true), 500.0 / fps);
    EXPECT_NEAR(*result->off.mean_ms, truth.mean_ms(false), 500.0 / fps);
    EXPECT_EQ(result->paired.lamp_alone + result->paired.patch_alone, 0U);
    EXPECT_TRUE(result->warnings.empty());
    EXPECT_EQ(result->repeated_frames, 0U);
}

TEST(VideoFiles, FramesThatAToolHasRepeatedAreCounted) {
    const TemporaryFolder folder;
    const LampAndDisplay set_up;
    sim::Random random(7, sim::Stream::Targets);
    const Truth truth = switch_lamp(set_up, 5, random);
    const std::size_t frames =
        film(folder.path(), FrameFormat::Grey8, {.fps = 240.0, .noise = 0.01}, set_up, truth, 7);
    const auto name = [&](std::size_t frame) { return folder / fmt::format("{:06}.png", frame); };
    for (const std::size_t frame : {std::size_t{3}, frames / 2, frames}) {
        fs::copy_file(name(frame - 1), name(frame), fs::copy_options::overwrite_existing);
    }
    const auto result = probe::measure_video(question(folder.path(), 240.0));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_EQ(result->repeated_frames, 3U);
    EXPECT_THAT(result->warnings,
                testing::ElementsAre(HasSubstr(fmt::format("3 of {} frames have every", frames))));
    EXPECT_EQ(probe::video_json(*result)["camera"]["repeated_frames"], 3);
}

INSTANTIATE_TEST_SUITE_P(Formats, VideoFormats,
                         testing::Values(std::pair{FrameFormat::Grey8, 240.0},
                                         std::pair{FrameFormat::Colour8, 480.0},
                                         std::pair{FrameFormat::Grey16, 240.0},
                                         std::pair{FrameFormat::Grey8, 1000.0}));

TEST(FramePicture, GivesLinearLightOfEveryFormat) {
    const TemporaryFolder folder;
    const fs::path file = folder / "frame.png";
    const probe::Region patch = *probe::parse_region("patch", FrameWriter::kPatch);
    for (const FrameFormat format :
         {FrameFormat::Grey8, FrameFormat::Colour8, FrameFormat::Grey16}) {
        for (const double light : {0.0, 0.01, 0.2, 0.5, 1.0}) {
            FrameWriter(format).write(file, 0.0, light);
            probe::FramePicture picture;
            ASSERT_TRUE(picture.read(file).has_value());
            EXPECT_NEAR(picture.brightness(patch), light, 0.003) << light;
            EXPECT_EQ(picture.width(), FrameWriter::kWidth);
        }
    }
}

TEST(VideoFiles, MissingNumbersAreNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    fs::remove(folder / "f5.png");
    EXPECT_THAT(refusal(folder.path()), HasSubstr("f5.png: is missing between f1.png and f9.png"));
}

TEST(VideoFiles, NumbersWithAndWithoutZerosAreOneVideo) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    FrameWriter(FrameFormat::Grey8).write(folder / "f10.png", 0.1, 0.1);
    std::ofstream(folder / "notes.txt") << "beside";
    const auto files = probe::FrameFiles::find(folder.path());
    ASSERT_TRUE(files.has_value()) << files.error().message;
    EXPECT_EQ(files->count(), 10U);
    EXPECT_EQ(files->file(9).filename(), "f10.png");
    FrameWriter(FrameFormat::Grey8).write(folder / "f03.png", 0.1, 0.1);
    EXPECT_THAT(refusal(folder.path()), HasSubstr("a number is there twice"));
}

TEST(VideoFiles, OtherPicturesAreNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    FrameWriter(FrameFormat::Grey8).write(folder / "g1.png", 0.1, 0.1);
    EXPECT_THAT(refusal(folder.path()), HasSubstr("is of another video than"));
    fs::rename(folder / "g1.png", folder / "cover.png");
    EXPECT_THAT(refusal(folder.path()), HasSubstr("cover.png: is not a numbered frame"));
}

TEST(VideoFiles, AnEmptyFolderAndNoneAreRefused) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder.path()), HasSubstr("has no PNG files"));
    EXPECT_THAT(refusal(folder / "none"), HasSubstr("cannot be read (No such file"));
    FrameWriter(FrameFormat::Grey8).write(folder / "1.png", 0.1, 0.1);
    EXPECT_THAT(refusal(folder / "1.png"), HasSubstr("cannot be read (Not a directory)"));
}

TEST(VideoFiles, AFrameThatIsNoPngOrCutShortIsNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    fs::resize_file(folder / "f4.png", fs::file_size(folder / "f4.png") / 2);
    EXPECT_THAT(refusal(folder.path()), HasSubstr("f4.png: cannot be read as a PNG"));
    std::ofstream(folder / "f2.png") << "not a picture";
    EXPECT_THAT(refusal(folder.path()), HasSubstr("f2.png: cannot be read as a PNG"));
}

TEST(VideoFiles, AnotherSizeIsNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 8;
    image.height = 9;
    image.format = PNG_FORMAT_GRAY;
    const std::vector<std::uint8_t> pixels(72);
    ASSERT_NE(
        png_image_write_to_file(&image, (folder / "f3.png").c_str(), 0, pixels.data(), 0, nullptr),
        0);
    EXPECT_THAT(refusal(folder.path()),
                HasSubstr("f3.png: has 8x9 pixels, f1.png before has 40x20"));
}

TEST(VideoFiles, ALightThatIsNeverSwitchedIsNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    EXPECT_THAT(refusal(folder.path()), HasSubstr("--lamp: its brightness stays between"));
}

TEST(VideoRegions, OutsideThePictureAreNamed) {
    const TemporaryFolder folder;
    write_dark(folder.path());
    probe::VideoQuestion asked = question(folder.path(), 240);
    asked.patch = {.x = 39, .y = 0, .width = 2, .height = 1};
    const auto result = probe::measure_video(asked);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, ErrorKind::Usage);
    EXPECT_THAT(result.error().message,
                HasSubstr("--patch 39,0,2,1: reaches out of the frames, which are 40x20 pixels"));
    asked.patch = {.x = 4294967295U, .y = 1, .width = 4294967295U, .height = 1};
    EXPECT_FALSE(probe::measure_video(asked).has_value());
}

TEST(VideoRegions, AreFourWholeNumbers) {
    EXPECT_EQ(*probe::parse_region("lamp", "1,2,3,4"), (probe::Region{1, 2, 3, 4}));
    const auto apart = [](const char* lamp, const char* patch) {
        return probe::check_regions_apart(*probe::parse_region("lamp", lamp),
                                          *probe::parse_region("patch", patch));
    };
    EXPECT_TRUE(apart("0,0,8,16", "8,0,8,16"));
    EXPECT_TRUE(apart("0,16,8,16", "0,0,8,16"));
    for (const char* patch : {"0,0,8,16", "7,15,1,1", "0,0,4294967295,4294967295"}) {
        const auto overlap = apart("0,0,8,16", patch);
        ASSERT_FALSE(overlap) << patch;
        EXPECT_EQ(overlap.error().kind, ErrorKind::Usage);
        EXPECT_THAT(overlap.error().message, HasSubstr("overlap"));
    }
    for (const char* const text :
         {"", "1,2,3", "1,2,3,4,", "1,2,3,4,5", "a,2,3,4", "-1,2,3,4", "1.5,2,3,4", "1,2,3,4 ",
          " 1,2,3,4", "1,2,0,4", "1,2,3,0", "4294967296,2,3,4", "1;2;3;4"}) {
        const auto region = probe::parse_region("lamp", text);
        ASSERT_FALSE(region.has_value()) << text;
        EXPECT_EQ(region.error().kind, ErrorKind::Usage);
        EXPECT_THAT(region.error().message, HasSubstr("--lamp " + std::string(text)));
    }
}

}  // namespace
}  // namespace gazeloop::tests
