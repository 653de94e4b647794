// What is written is read again: native, table of angles, BIDS.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/bids_rules.h"
#include "drivers/trace/bids/write_bids.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/text_output.h"
#include "tests/unit/drivers/trace/formats/format_files.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

gaze::GazeTrace two_eyes() {
    gaze::GazeTrace trace{.file = "made", .format = "gazeloop", .device = "Made \"up\""};
    for (int i = 0; i < 50; ++i) {
        gaze::GazeSample& sample = trace.samples.emplace_back();
        sample.sequence = static_cast<std::uint64_t>(i);
        sample.device_ns = 1'000 + i * 4'000'001LL;
        sample.sampled = {i * 4'000'001LL, time::StampKind::Modelled};
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
            const double side = eye == gaze::Eye::Left ? 1.0 : -1.0;
            ray.valid = i % 10 != 4 || eye == gaze::Eye::Right;
            ray.direction = of_azimuth_elevation(0.01 * i - 0.2 + 0.02 * side, 0.1 - 0.003 * i);
            ray.origin_m = {-0.031 * side, 0.001, -0.002};
            ray.openness = 0.9 - 0.01 * i;
            ray.confidence = 0.5;
        }
        if (i % 2 == 0) {
            sample.head = gaze::Pose{glm::normalize(glm::dquat{1.0, 0.1, 0.01 * i, 0.0}),
                                     {0.1, 1.6, -0.001 * i}};
        }
    }
    return trace;
}

gaze::GazeTrace one_ray() {
    gaze::GazeTrace trace = two_eyes();
    for (gaze::GazeSample& sample : trace.samples) {
        sample.eyes[1].direction = sample.eyes[0].direction;
        sample.eyes[1].valid = sample.eyes[0].valid;
        sample.parallax_rad = 0.0632;
    }
    return trace;
}

enum class Keeps { All, NoPlaces };

void expect_same(const gaze::GazeTrace& read, const gaze::GazeTrace& written, Keeps keeps) {
    ASSERT_EQ(read.samples.size(), written.samples.size());
    for (std::size_t i = 0; i < read.samples.size(); ++i) {
        const gaze::GazeSample& a = read.samples[i];
        const gaze::GazeSample& b = written.samples[i];
        EXPECT_EQ(a.sampled.ns, b.sampled.ns);
        for (const std::size_t e : {0U, 1U}) {
            EXPECT_EQ(a.eyes[e].valid, b.eyes[e].valid) << i;
            if (b.eyes[e].valid) {
                expect_near(a.eyes[e].direction, b.eyes[e].direction, 1e-15 * 4);
            }
            EXPECT_EQ(a.eyes[e].openness, b.eyes[e].openness);
            EXPECT_EQ(a.eyes[e].confidence, b.eyes[e].confidence);
            if (keeps == Keeps::All) {
                EXPECT_EQ(a.eyes[e].origin_m, b.eyes[e].origin_m);
            }
        }
        ASSERT_EQ(a.head.has_value(), b.head.has_value()) << i;
        if (a.head) {
            EXPECT_EQ(a.head->position_m, b.head->position_m);
            EXPECT_LT(glm::length(a.head->orientation - b.head->orientation), 1e-15);
        }
    }
}

TEST(NativeTrace, KeepsTheParallaxOfOneRayForBothEyes) {
    RecordingFolder folder;
    const std::string file = folder / "t.csv.gz";
    const gaze::GazeTrace trace = one_ray();
    value_or_throw(write_native_trace(trace, file));
    const gaze::GazeTrace read = value_or_throw(read_trace(file));
    expect_same(read, trace, Keeps::All);
    EXPECT_EQ(read.samples[7].parallax_rad, 0.0632);
    EXPECT_EQ(read.device, "Made \"up\"");
    std::ostringstream without;
    write_native_trace(two_eyes(), without);
    EXPECT_EQ(without.str().find("parallax"), std::string::npos) << "only where a sample has one";
}

TEST(AngleTable, IsReadAgain) {
    RecordingFolder folder;
    const gaze::GazeTrace trace = two_eyes();
    const std::string file = folder / "t.csv";
    TextOutput out(file);
    write_angle_table(trace, out.stream());
    value_or_throw(out.close());
    const gaze::GazeTrace read = value_or_throw(read_trace(file));
    EXPECT_EQ(read.format, "angles");
    expect_same(read, trace, Keeps::NoPlaces);
}

TEST(AngleTable, CountsAnglesThatNoDirectionHas) {
    RecordingFolder folder;
    std::string text = "time_s,left_azimuth_deg,left_elevation_deg\n";
    for (int i = 0; i < 100; ++i) {
        text += fmt::format("{},{},1\n", 0.01 * i, i == 50 ? "1e300" : i == 51 ? "-360.5" : "359");
    }
    const gaze::GazeTrace read = value_or_throw(read_trace(folder.write("t.csv", text)));
    EXPECT_FALSE(read.samples[50].eyes[0].valid);
    EXPECT_FALSE(read.samples[51].eyes[0].valid);
    EXPECT_TRUE(read.samples[52].eyes[0].valid) << "eyes of a head that turned round";
    const auto& findings = read.report.findings();
    const auto bad =
        std::ranges::find(findings, gaze::TraceFindingKind::BadCells, &gaze::TraceFinding::kind);
    ASSERT_NE(bad, findings.end());
    EXPECT_EQ(bad->rows, 2U);
    EXPECT_THAT(bad->text, HasSubstr("'1e300' is an angle beyond a full turn"));
}

TEST(NativeTrace, CountsVectorsThatNoDirectionHas) {
    RecordingFolder folder;
    std::string text = "t_device_ns,left_valid,left_x,left_y,left_z\n";
    for (int i = 0; i < 100; ++i) {
        text += fmt::format("{},1,0,0,{}\n", i * 10'000'000LL, i == 50 ? "-1e300" : "-2");
    }
    const gaze::GazeTrace read = value_or_throw(read_trace(folder.write("t.csv", text)));
    EXPECT_FALSE(read.samples[50].eyes[0].valid);
    EXPECT_TRUE(read.samples[51].eyes[0].valid) << "made a unit vector";
}

TEST(WriteBids, WritesEachEyeByItsRules) {
    RecordingFolder folder;
    const gaze::GazeTrace trace = two_eyes();
    const WrittenBids written = value_or_throw(write_bids(trace, folder / "ds", {"7", "look"}));
    EXPECT_THAT(written.left_out, IsEmpty());
    EXPECT_THAT(written.files, SizeIs(9));
    const std::string left = folder / "ds/sub-7/beh/sub-7_task-look_recording-eye1_physio.tsv.gz";
    for (const std::filesystem::path& file : written.files) {
        EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
    for (const auto& [eye, recorded] : {std::pair{"eye1", "left"}, {"eye2", "right"}}) {
        const auto sidecar =
            value_or_throw(inherited_json(with_recording(left, eye, "physio"), "physio"));
        EXPECT_THAT(broken_bids_rules(sidecar, {}), IsEmpty());
        EXPECT_EQ(sidecar["RecordedEye"], recorded);
    }
    const gaze::GazeTrace read = value_or_throw(read_trace(left));
    EXPECT_EQ(read.format, "bids");
    EXPECT_EQ(read.report.rows_dropped(), 0U);
    expect_same(read, trace, Keeps::All);
    expect_anatomy(read);

    // The same once more gives the same bytes.
    std::ifstream first(left, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(first), {}};
    value_or_throw(write_bids(trace, folder / "ds", {"7", "look"}));
    std::ifstream second(left, std::ios::binary);
    EXPECT_EQ(bytes, (std::string{std::istreambuf_iterator<char>(second), {}}));
}

TEST(WriteBids, RemovesTheEyesOfTheRecordingBefore) {
    const tests::TemporaryFolder folder;
    value_or_throw(write_bids(two_eyes(), folder / "ds"));
    const auto eye2 =
        folder / "ds" / "sub-01" / "beh" / "sub-01_task-gaze_recording-eye2_physio.tsv.gz";
    ASSERT_TRUE(std::filesystem::exists(eye2));
    gaze::GazeTrace one = two_eyes();
    for (gaze::GazeSample& sample : one.samples) {
        sample.eyes[1].valid = false;
    }
    const WrittenBids written = value_or_throw(write_bids(one, folder / "ds"));
    EXPECT_FALSE(std::filesystem::exists(eye2));
    EXPECT_THAT(written.left_out, ::testing::Contains(::testing::HasSubstr("eye2_physio.tsv.gz")));
}

TEST(WriteBids, WritesOneRayAsTheCyclopeanEye) {
    RecordingFolder folder;
    const gaze::GazeTrace trace = one_ray();
    const WrittenBids written = value_or_throw(write_bids(trace, folder / "ds"));
    EXPECT_THAT(written.left_out, ElementsAre(HasSubstr("openness"), HasSubstr("place")));
    const std::string file = folder / "ds/sub-01/beh/sub-01_task-gaze_recording-eye1_physio.tsv.gz";
    const gaze::GazeTrace read = value_or_throw(read_trace(file));
    ASSERT_EQ(read.samples.size(), trace.samples.size());
    expect_near(read.samples[9].eyes[1].direction, trace.samples[9].eyes[0].direction, 4e-15);
    EXPECT_TRUE(read.samples[9].parallax_rad);
}

TEST(WriteBids, WritesLosses) {
    RecordingFolder folder;
    value_or_throw(write_bids(two_eyes(), folder / "ds"));
    std::ifstream in(folder / "ds/sub-01/beh/sub-01_task-gaze_recording-eye1_physioevents.tsv.gz",
                     std::ios::binary);
    const auto lines = [&] {
        TextLines text(in, "events");
        std::vector<std::string> all;
        while (value_or_throw(text.next())) {
            all.emplace_back(text.text());
        }
        return all;
    }();
    ASSERT_THAT(lines, SizeIs(5));
    EXPECT_EQ(lines[0], "16000004\t0.004000001\tloss");
}

TEST(WriteBids, RefusesWhatBidsCannotHold) {
    RecordingFolder folder;
    const auto said = [&](const gaze::GazeTrace& trace, const BidsLabels& labels) {
        const auto written = write_bids(trace, folder / "ds", labels);
        return written ? std::string{} : written.error().message;
    };
    EXPECT_THAT(said(two_eyes(), {"a-b", "t"}), HasSubstr("'a-b' is no label of BIDS"));
    EXPECT_THAT(said(two_eyes(), {"1", ""}), HasSubstr("'' is no label of BIDS"));
    gaze::GazeTrace one = two_eyes();
    one.samples.resize(1);
    EXPECT_THAT(said(one, {}), HasSubstr("have no rate"));
    EXPECT_THAT(said(two_eyes(), {}), "");
    folder.write("file", "");
    const auto into = write_bids(two_eyes(), folder / "file");
    ASSERT_FALSE(into);
    EXPECT_THAT(into.error().message, HasSubstr("cannot be made"));
}

TEST(TextOutput, SaysWhatCannotBeWritten) {
    for (const char* const file : {"/nonexistent/x.csv", "/nonexistent/x.csv.gz"}) {
        TextOutput out(file);
        out.stream() << "text";
        const auto closed = out.close();
        ASSERT_FALSE(closed) << file;
        EXPECT_THAT(closed.error().message, HasSubstr("cannot be written (No such file"));
    }
    for (const char* const file : {"/dev/full"}) {
        TextOutput out(file);
        out.stream() << "text";
        EXPECT_FALSE(out.close()) << file;
    }
}

TEST(TextOutput, LeavesWhatWasThereUntilTheNewFileIsWhole) {
    const tests::TemporaryFolder folder;
    const auto content = [](const std::filesystem::path& file) {
        std::ifstream in(file);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    std::ofstream(folder / "a.csv") << "before";
    std::filesystem::create_symlink("a.csv", folder / "link.csv");
    {
        TextOutput given_up((folder / "a.csv").string());
        given_up.stream() << "half" << std::flush;
    }
    EXPECT_EQ(content(folder / "a.csv"), "before");
    TextOutput out((folder / "link.csv").string());
    out.stream() << "after";
    EXPECT_EQ(content(folder / "a.csv"), "before");
    EXPECT_TRUE(out.close().has_value());
    EXPECT_EQ(content(folder / "a.csv"), "after");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.csv"));
    std::size_t files = 0;
    for (const auto& one : std::filesystem::directory_iterator(folder / "")) {
        files += one.exists() ? 1 : 0;
    }
    EXPECT_EQ(files, 2U) << "nothing unfinished stays";
}

}  // namespace
}  // namespace gazeloop::drivers
