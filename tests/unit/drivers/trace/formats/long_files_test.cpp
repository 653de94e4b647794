// Files that are longer than what is held of them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <sstream>
#include <string>

#include "drivers/trace/bids/write_bids.h"
#include "drivers/trace/directions.h"
#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/text_output.h"
#include "runtime/memory/long_memory.h"
#include "runtime/memory/scratch_file.h"
#include "tests/unit/drivers/trace/formats/format_files.h"
#include "tests/unit/drivers/trace/trace_text.h"
#include "tests/unit/session/child_process.h"

namespace gazeloop::drivers {
namespace {

/// More than a spool holds back, and long blocks of what clocks are judged by.
constexpr int kRows = 12'000;

/// Gaze that jumps every 300 ms, with noise, so that no two rows are alike.
int fixation(int i) { return i / 60; }
double azimuth_deg(int i) { return 9.0 * std::sin(1.7 * fixation(i)) + 0.01 * std::sin(31.0 * i); }
double elevation_deg(int i) {
    return 5.0 * std::cos(2.3 * fixation(i)) + 0.01 * std::cos(17.0 * i);
}

/// Rows in which something is to be found: two change places, one says nothing that is understood.
int place(int i) { return i == 500 ? 501 : i == 501 ? 500 : i; }
std::string cell(int i, double number) { return i == 700 ? "abc" : fmt::format("{:.6f}", number); }

gaze::GazeTrace made(int rows) {
    gaze::GazeTrace trace{.file = "made", .format = "gazeloop", .device = "Made"};
    for (int i = 0; i < rows; ++i) {
        gaze::GazeSample& sample = trace.samples.emplace_back();
        sample.sequence = static_cast<std::uint64_t>(i) + (i > 900 ? 3 : 0);
        sample.device_ns = place(i) * 5'000'000LL;
        sample.sampled = {i * 5'000'000LL, time::StampKind::Modelled};
        sample.arrived = {sample.device_ns + 3'000'000 + (i * 7919) % 900'000,
                          time::StampKind::Modelled};
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
            const double side = eye == gaze::Eye::Left ? 1.0 : -1.0;
            ray.valid = i % 400 > 30;
            ray.direction = of_azimuth_elevation(glm::radians(azimuth_deg(i) + 1.2 * side),
                                                 glm::radians(elevation_deg(i)));
            ray.origin_m = {-0.031 * side, 0.001, -0.002};
            ray.openness = ray.valid ? 0.9 : 0.05;
            ray.confidence = 0.5;
        }
        sample.head =
            gaze::Pose{glm::normalize(glm::dquat{1.0, 0.0, 1e-5 * i, 0.0}), {0.1, 1.6, -1e-5 * i}};
    }
    return trace;
}

/// A file of a format, in a folder.
struct LongFile {
    std::string format;
    std::function<std::string(RecordingFolder& folder)> write;
};

void PrintTo(const LongFile& file, std::ostream* out) { *out << file.format; }

LongFile table(const std::string& format, const std::string& name, const std::string& header,
               const std::function<std::string(int)>& row) {
    return {format, [=](RecordingFolder& folder) {
                std::string text = header;
                for (int i = 0; i < kRows; ++i) {
                    text += row(i);
                }
                return folder.write(name, text);
            }};
}

std::string pose_free_htc(int i) {
    const double x = std::sin(glm::radians(azimuth_deg(i)));
    const double y = std::sin(glm::radians(elevation_deg(i)));
    const std::string left = fmt::format("{};{:.6f};1", cell(i, -x - 0.02), y);
    const std::string right = fmt::format("{:.6f};{:.6f};1", -x + 0.02, y);
    return htc_row(place(i) * 83'333LL, left, right);
}

std::vector<LongFile> long_files() {
    const auto angle = [](int i, double more) { return cell(i, azimuth_deg(i) + more); };
    const std::string pro_lab =
        "Recording timestamp [us]\tSensor\tGaze direction left X [HUCS norm]\tGaze direction left "
        "Y [HUCS norm]\tGaze direction left Z [HUCS norm]\tValidity left\n";
    return {
        {"gazeloop",
         [](RecordingFolder& folder) {
             std::ostringstream text;
             write_native_trace(made(kRows), text);
             return folder.write("gaze.csv", text.str());
         }},
        {"angles",
         [](RecordingFolder& folder) {
             std::ostringstream text;
             write_angle_table(made(kRows), text);
             return folder.write("angles.csv", text.str());
         }},
        {"bids",
         [](RecordingFolder& folder) {
             const auto written = value_or_throw(write_bids(made(kRows), folder / "ds"));
             return (folder / "ds") + "/sub-01/beh/sub-01_task-gaze_recording-eye1_physio.tsv.gz";
         }},
        table("htc-vive-pro", "htc.csv", std::string{kHtcHeader} + "\r\n", pose_free_htc),
        table("pico-neo-3", "pico.csv",
              "User Name\tTimeline\tHead Position. x\tHead Position. y\tHead Position. z\t"
              "Head Rotation. x\tHead Rotation. y\tHead Rotation. z\tLeft Eye Gaze Openness\t"
              "Right Eye Gaze Openness\tCombine Eye Gaze Vector. x\tCombine Eye Gaze Vector. y\t"
              "Combine Eye Gaze Vector. z\tFoveated Gaze Tracking State\n",
              [](int i) {
                  return fmt::format(
                      "u\t{:.6f}\t1\t2\t3\t0\t{:.4f}\t0\t0.9\t0.7\t{}\t{:.6f}\t1\t0\n",
                      1.1 + 0.011 * place(i), 1e-3 * i,
                      cell(i, std::sin(glm::radians(azimuth_deg(i)))),
                      std::sin(glm::radians(elevation_deg(i))));
              }),
        table("pupil-labs", "gaze.csv",
              "section id,recording id,timestamp [ns],gaze x [px],gaze y [px],worn,fixation id,"
              "blink id,azimuth [deg],elevation [deg]\n",
              [=](int i) {
                  return fmt::format("s,r,{},484.3,525.1,1,,{},{},{:.6f}\n",
                                     1'629'390'345'036'471'431 + place(i) * 5'000'000LL,
                                     i % 400 > 30 ? "" : "1", angle(i, 0.0), elevation_deg(i));
              }),
        table("pupil-core", "gaze_positions.csv",
              "gaze_timestamp,world_index,confidence,eye_center0_3d_x,eye_center0_3d_y,"
              "eye_center0_3d_z,gaze_normal0_x,gaze_normal0_y,gaze_normal0_z,eye_center1_3d_x,"
              "eye_center1_3d_y,eye_center1_3d_z,gaze_normal1_x,gaze_normal1_y,gaze_normal1_z\n",
              [](int i) {
                  const double x = std::sin(glm::radians(azimuth_deg(i)));
                  return fmt::format("{:.6f},1,{},31,12,-20,{},0.1,1,-32,13,-21,{:.6f},0.1,1\n",
                                     81.5 + 0.008 * place(i), i % 400 > 30 ? 0.95 : 0.1,
                                     cell(i, x - 0.04), x + 0.04);
              }),
        table("tobii-pro-lab", "lab.tsv", pro_lab,
              [](int i) {
                  return fmt::format(
                      "{}\tGyroscope\t\t\t\t\n{}\tEye Tracker\t{}\t{:.6f}\t1\tValid\n",
                      10'000 * i + 5'000, 10'000 * place(i) + 10'000,
                      cell(i, -std::sin(glm::radians(azimuth_deg(i)))),
                      std::sin(glm::radians(elevation_deg(i))));
              }),
        table("aria", "general_eye_gaze.csv",
              "tracking_timestamp_us,yaw_rads_cpf,pitch_rads_cpf,left_yaw_rads_cpf,"
              "right_yaw_rads_cpf,left_pitch_rads_cpf,right_pitch_rads_cpf,tx_left_eye_cpf,"
              "ty_left_eye_cpf,tz_left_eye_cpf,tx_right_eye_cpf,ty_right_eye_cpf,"
              "tz_right_eye_cpf\n",
              [](int i) {
                  const double yaw = -glm::radians(azimuth_deg(i));
                  return fmt::format("{},{:.6f},0.3,{},{:.6f},0.3,0.3,0.0315,0,0,-0.0315,0,0\n",
                                     7'000'000 + 11'111LL * place(i), yaw, cell(i, yaw - 0.02),
                                     yaw + 0.02);
              }),
        table("gazebase-vr", "vr.csv", "n,x,y,lx,ly,rx,ry,xT,yT,zT,clx,cly,clz,crx,cry,crz\n",
              [=](int i) {
                  return fmt::format(
                      "{},0,0,{},{:.6f},{:.6f},{:.6f},0,0,1,-0.031,0.001,0.002,0.032,0.001,0.002\n",
                      4 * place(i), angle(i, 1.0), elevation_deg(i), azimuth_deg(i) - 1.0,
                      elevation_deg(i));
              }),
        {"screen-px",
         [](RecordingFolder& folder) {
             folder.write("px.json", R"({"screen_size_m": [0.4, 0.3], "screen_px": [1000, 600],
                                         "view_distance_m": 0.5})");
             std::string text = "t_ms,x_px,y_px\n";
             for (int i = 0; i < kRows; ++i) {
                 text += fmt::format("{}.0,{},{:.3f}\n", 2 * place(i),
                                     cell(i, 500.0 + 20.0 * azimuth_deg(i)),
                                     300.0 - 20.0 * elevation_deg(i));
             }
             return folder.write("px.csv", text);
         }},
        table("tobii-glasses-3", "gazedata", "",
              [](int i) {
                  const double x = std::sin(glm::radians(azimuth_deg(i)));
                  return fmt::format(
                      R"({{"type":"gaze","timestamp":{:.6f},"data":{{"eyeleft":{{"gazeorigin":)"
                      R"([28.5,-11,-25.2],"gazedirection":[{:.6f},0.2,1]}},"eyeright":)"
                      R"({{"gazeorigin":[-31.8,-9.4,-25.9],"gazedirection":[{:.6f},0.2,1]}}}}}})"
                      "\n",
                      0.01 * place(i), -x - 0.02, -x + 0.02);
              }),
        {"eyelink-asc",
         [](RecordingFolder& folder) {
             folder.write("eye.json", R"({"screen_size_m": [0.4, 0.3], "view_distance_m": 0.5})");
             std::string text =
                 "** CONVERTED FROM a.edf\nMSG\t1 DISPLAY_COORDS 0 0 999 599\n"
                 "SAMPLES\tGAZE\tRIGHT\tRATE\t1000.00\n";
             for (int i = 0; i < kRows; ++i) {
                 text += fmt::format("{}\t{}\t{:.3f}\t1000.0\n", 200 + place(i),
                                     cell(i, 500.0 + 20.0 * azimuth_deg(i)),
                                     300.0 - 20.0 * elevation_deg(i));
             }
             return folder.write("eye.asc", text);
         }},
    };
}

/// All that a file is written as, and what was found in it.
std::string told(const gaze::RecordingView& trace, RecordingFolder& folder, const char* data_set) {
    std::ostringstream text;
    write_native_trace(trace, text);
    write_angle_table(trace, text);
    for (const std::filesystem::path& file :
         value_or_throw(write_bids(trace, folder / data_set)).files) {
        text << std::ifstream(file, std::ios::binary).rdbuf();
    }
    const gaze::TraceReport& report = trace.report;
    text << report.rows << report.rate_hz << report.clock << report.axes << report.valid[0] << ' '
         << report.valid[1] << ' ' << report.longest_gap_ns;
    for (const gaze::TraceFinding& finding : report.findings()) {
        text << '\n' << finding.line << ' ' << finding.rows << ' ' << finding.text;
    }
    return text.str();
}

class LongFiles : public testing::TestWithParam<LongFile> {};

TEST_P(LongFiles, AreReadAndWrittenTheSameFromScratchFiles) {
    RecordingFolder folder;
    const std::string file = GetParam().write(folder);
    const gaze::GazeTrace in_memory = value_or_throw(read_trace(file));
    ASSERT_EQ(in_memory.format, GetParam().format);
    ASSERT_GT(in_memory.samples.size(), std::size_t{kRows} - 10);
    const std::string expected = told(in_memory, folder, "from_memory");

    // Where a scratch file is noticed, if that is there.
    const std::string noticing = "/dev/shm";
    const auto there = memory::ScratchFile::make(noticing);
    const bool noticed = there && !there->in_memory().empty();
    if (noticed) {
        setenv("TMPDIR", noticing.c_str(), 1);
    }
    const memory::MemoryLimit limit(0);
    const gaze::GazeRecording recording = value_or_throw(read_recording(file));
    if (noticed) {
        EXPECT_NE(limit.doubt(), "") << "nothing was long enough for a scratch file";
    }
    EXPECT_EQ(told(recording, folder, "from_files"), expected);
    if (noticed) {
        unsetenv("TMPDIR");
    }
}

INSTANTIATE_TEST_SUITE_P(Of, LongFiles, testing::ValuesIn(long_files()), [](const auto& file) {
    std::string name = file.param.format;
    std::ranges::replace(name, '-', '_');
    return name;
});

/// A native trace, written row by row.
void write_long_trace(const std::string& file, int rows) {
    std::ofstream out(file, std::ios::binary);
    out << kNativeHeader << '\n';
    for (int i = 0; i < rows; ++i) {
        out << fmt::format(
            "{},{},{},1,{:.4f},0,-1,-0.03,0,0,1,0.9,1,{:.4f},0,-1,0.03,0,0,1,0.9,,,,"
            ",,,\n",
            i, i * 1'000'000LL, i * 1'000'000LL + 2'000'000 + (i * 7919LL) % 90'000,
            0.1 + 1e-4 * (i % 977), 0.08 + 1e-4 * (i % 977));
    }
}

/// How much data memory (RLIMIT_DATA: all that is the process's own) it has now, bytes.
std::size_t data_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::size_t kilobytes = 0;
        if (word == "VmData:" && status >> kilobytes) {
            return 1024 * kilobytes;
        }
    }
    return 0;
}

enum Ending { kConverted = 0, kNoMemory = 3 };

/// Converts in a process of its own that may take no more memory than this beyond what it has.
int converted_within(std::size_t bytes, const std::string& in, const std::string& out,
                     std::size_t limit_bytes) {
    return session::run_in_child([&] {
        const rlim_t most = data_bytes() + bytes;
        const rlimit data{most, most};
        setrlimit(RLIMIT_DATA, &data);
        try {
            const memory::MemoryLimit limit(limit_bytes);
            const gaze::GazeRecording recording = value_or_throw(read_recording(in));
            value_or_throw(write_native_trace(recording, out));
        } catch (const std::bad_alloc&) {
            return int{kNoMemory};
        }
        return int{kConverted};
    });
}

/// Eight times the rows, in the same memory: what is let be in it, the readers' and writers'
/// buffers, and the stack and heap of the thread that lets go of pages. Without the limit that is
/// not enough, so it is one.
TEST(LongFiles, AreConvertedInMemoryThatTheirLengthDoesNotChange) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take memory of their own";
#endif
    constexpr std::size_t kMegabyte = std::size_t{1} << 20U;
    constexpr std::size_t kHeld = 4 * kMegabyte;
    constexpr std::size_t kOthers = 16 * kMegabyte;
    constexpr int kShort = 30'000;
    RecordingFolder folder;
    for (const int times : {1, 8}) {
        const std::string in = folder / fmt::format("{}.csv", times);
        write_long_trace(in, times * kShort);
        EXPECT_EQ(converted_within(kHeld + kOthers, in, folder / "out.csv", kHeld), kConverted)
            << times;
        if (times == 8) {
            EXPECT_EQ(converted_within(kHeld + kOthers, in, folder / "out.csv",
                                       std::numeric_limits<std::size_t>::max() - 1),
                      kNoMemory);
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
