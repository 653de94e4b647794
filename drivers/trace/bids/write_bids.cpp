#include "drivers/trace/bids/write_bids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "drivers/trace/text/line_writer.h"
#include "drivers/trace/text/text_output.h"

namespace gazeloop::drivers {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kMissing = "n/a";

std::unexpected<Error> bad_input(std::string what) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(what)});
}

bool is_label(std::string_view label) {
    return !label.empty() && std::ranges::all_of(label, [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    });
}

Expected<void> write_json(const fs::path& file, const Json& json) {
    TextOutput out(file.string());
    out.stream() << json.dump(4, ' ', false, Json::error_handler_t::replace) << '\n';
    return out.close();
}

/// One recording: of an eye, or of both at once.
struct Recording {
    gaze::Eye eye;  ///< whose rays are written
    std::string_view recorded;
};

std::vector<Recording> recordings_of(const gaze::RecordingView& trace) {
    bool shared = true;
    gaze::PerEye<bool> any{};
    for (const gaze::GazeSample& sample : trace.samples) {
        const auto& [left, right] = sample.eyes;
        any[0] = any[0] || left.valid;
        any[1] = any[1] || right.valid;
        shared = shared && left.valid == right.valid &&
                 (!left.valid || left.direction == right.direction);
    }
    if (shared) {
        return {{gaze::Eye::Left, "cyclopean"}};
    }
    std::vector<Recording> recordings;
    for (const gaze::Eye eye : gaze::kEyes) {
        if (any[gaze::index(eye)]) {
            recordings.push_back({eye, gaze::kEyeNames[gaze::index(eye)]});
        }
    }
    return recordings;
}

/// Which columns of our own a recording needs.
struct Extras {
    bool openness = false;
    bool confidence = false;
    bool origin = false;
    bool head = false;
};

Extras extras_of(const gaze::RecordingView& trace, const Recording& recording) {
    const bool of_one_eye = recording.recorded != "cyclopean";
    Extras extras;
    for (const gaze::GazeSample& sample : trace.samples) {
        const gaze::EyeRay& ray = sample.eyes[gaze::index(recording.eye)];
        extras.openness = extras.openness || (of_one_eye && ray.openness >= 0.0);
        extras.confidence = extras.confidence || ray.confidence >= 0.0;
        extras.origin = extras.origin || (of_one_eye && ray.origin_m != glm::dvec3{0.0});
        extras.head = extras.head || sample.head.has_value();
    }
    return extras;
}

Json sidecar_of(const gaze::RecordingView& trace, const Recording& recording, const Extras& extras,
                double rate_hz) {
    Json columns = {"timestamp", "x_coordinate", "y_coordinate"};
    Json json{{"PhysioType", "eyetrack"},
              {"RecordedEye", recording.recorded},
              {"SampleCoordinateSystem", "eye-in-head"},
              {"SamplingFrequency", rate_hz},
              {"StartTime", 0},
              {"Manufacturer", trace.device},
              {"Columns", nullptr},
              {"timestamp", {{"Description", "time since the first sample"}, {"Units", "ns"}}},
              {"x_coordinate",
               {{"LongName", "Azimuth of the gaze"},
                {"Description", "about the head's vertical axis, positive to the right"},
                {"Units", "deg"}}},
              {"y_coordinate",
               {{"LongName", "Elevation of the gaze"},
                {"Description", "above the head's horizontal plane, positive up"},
                {"Units", "deg"}}}};
    const auto add = [&](std::string_view name, std::string_view description,
                         std::string_view unit) {
        columns.push_back(name);
        json[std::string{name}] = {{"Description", description}, {"Units", unit}};
    };
    if (extras.openness) {
        add("eye_openness", "0 closed to 1 open", "1");
    }
    if (extras.confidence) {
        add("confidence", "of the tracker in the gaze, 0 to 1", "1");
    }
    if (extras.origin) {
        for (const std::string_view axis : {"x", "y", "z"}) {
            add(fmt::format("origin_{}_m", axis),
                "place of the eye in the head: x right, y up, -z ahead", "m");
        }
    }
    if (extras.head) {
        for (const std::string_view axis : {"x", "y", "z"}) {
            add(fmt::format("head_{}_m", axis),
                "place of the head in the world: x right, y up, -z ahead", "m");
        }
        for (const std::string_view axis : {"x", "y", "z", "w"}) {
            add(fmt::format("head_q{}", axis),
                "orientation of the head in the world, a unit quaternion", "1");
        }
    }
    json["Columns"] = std::move(columns);
    return json;
}

void write_rows(const gaze::RecordingView& trace, const Recording& recording, const Extras& extras,
                std::ostream& out) {
    LineWriter line('\t', kMissing);
    for (const gaze::GazeSample& sample : trace.samples) {
        if (!sample.sampled.known()) {
            continue;
        }
        const gaze::EyeRay& ray = sample.eyes[gaze::index(recording.eye)];
        line.add(sample.sampled.ns);
        line.add_angles(ray);
        if (extras.openness) {
            line.add_if_known(ray.openness);
        }
        if (extras.confidence) {
            line.add_if_known(ray.confidence);
        }
        if (extras.origin) {
            line.add_place(ray.origin_m);
        }
        if (extras.head && sample.head) {
            const glm::dquat& q = sample.head->orientation;
            line.add_finite(sample.head->position_m);
            line.add_finite({q.x, q.y, q.z});
            line.add_finite(q.w);
        } else if (extras.head) {
            for (int i = 0; i < 7; ++i) {
                line.add_missing();
            }
        }
        line.end(out);
    }
}

/// Where the gaze of an eye is lost: from the first sample without it to the next one with it.
void write_losses(const gaze::RecordingView& trace, const Recording& recording, std::ostream& out) {
    std::optional<std::int64_t> since_ns;
    std::int64_t last_ns = 0;
    LineWriter line('\t', kMissing);
    const auto end = [&](std::int64_t now_ns) {
        line.add(*since_ns);
        line.add(static_cast<double>(now_ns - *since_ns) * 1e-9);
        line.add_text("loss");
        line.end(out);
        since_ns.reset();
    };
    for (const gaze::GazeSample& sample : trace.samples) {
        if (!sample.sampled.known()) {
            continue;
        }
        last_ns = sample.sampled.ns;
        const bool valid = sample.eyes[gaze::index(recording.eye)].valid;
        if (!valid) {
            since_ns = since_ns.value_or(last_ns);
        } else if (since_ns) {
            end(last_ns);
        }
    }
    if (since_ns) {
        end(last_ns);
    }
}

constexpr std::size_t kMostEyes = 3;  ///< labels of BIDS: eye1, eye2, eye3

class Writer {
  public:
    Writer(const gaze::RecordingView& trace, fs::path folder, const BidsLabels& labels)
        : trace_(trace), folder_(std::move(folder)), labels_(labels) {}

    Expected<WrittenBids> write(double rate_hz) {
        const fs::path beh = folder_ / fmt::format("sub-{}", labels_.subject) / "beh";
        std::error_code error;
        fs::create_directories(beh, error);
        if (error) {
            return bad_input(fmt::format("{}: cannot be made ({})", beh.string(), error.message()));
        }
        if (const Expected<void> described = describe_data_set(); !described) {
            return std::unexpected(described.error());
        }
        const std::vector<Recording> recordings = recordings_of(trace_);
        const auto stem_of = [&](std::size_t eye) {
            return (beh / fmt::format("sub-{}_task-{}_recording-eye{}", labels_.subject,
                                      labels_.task, eye))
                .string();
        };
        for (std::size_t i = 0; i < recordings.size(); ++i) {
            if (const Expected<void> one = write(recordings[i], stem_of(i + 1), rate_hz); !one) {
                return std::unexpected(one.error());
            }
        }
        for (std::size_t eye = recordings.size() + 1; eye <= kMostEyes; ++eye) {
            remove_eye(stem_of(eye));
        }
        if (recordings.front().recorded == "cyclopean") {
            say_what_is_lost();
        }
        return std::move(written_);
    }

  private:
    /// An eye of the recording that stood here before: read beside the new ones, it would be taken
    /// for the same person's.
    void remove_eye(const std::string& stem) {
        for (const char* const end :
             {"_physio.tsv.gz", "_physio.json", "_physioevents.tsv.gz", "_physioevents.json"}) {
            std::error_code error;
            if (fs::remove(stem + end, error)) {
                written_.left_out.push_back(fmt::format(
                    "{}{}, of the recording that was there before: removed", stem, end));
            }
        }
    }

    Expected<void> describe_data_set() {
        const fs::path description = folder_ / "dataset_description.json";
        std::error_code ignored;
        if (fs::exists(description, ignored)) {
            return {};
        }
        return add(description,
                   write_json(description, {{"Name", "Recorded gaze"},
                                            {"BIDSVersion", "1.11.1"},
                                            {"DatasetType", "raw"},
                                            {"GeneratedBy", {{{"Name", "gazeloop"}}}}}));
    }

    Expected<void> write(const Recording& recording, const std::string& stem, double rate_hz) {
        const Extras extras = extras_of(trace_, recording);
        TextOutput rows(stem + "_physio.tsv.gz");
        write_rows(trace_, recording, extras, rows.stream());
        TextOutput losses(stem + "_physioevents.tsv.gz");
        write_losses(trace_, recording, losses.stream());
        for (auto& [file, done] : std::array<std::pair<std::string, Expected<void>>, 4>{
                 {{"_physio.tsv.gz", rows.close()},
                  {"_physio.json", write_json(stem + "_physio.json",
                                              sidecar_of(trace_, recording, extras, rate_hz))},
                  {"_physioevents.tsv.gz", losses.close()},
                  {"_physioevents.json",
                   write_json(stem + "_physioevents.json",
                              {{"Columns", {"onset", "duration", "trial_type"}},
                               {"OnsetSource", "timestamp"},
                               {"trial_type",
                                {{"Description", "what happened"},
                                 {"Levels", {{"loss", "the gaze is not known"}}}}}})}}}) {
            if (const Expected<void> added = add(stem + file, done); !added) {
                return added;
            }
        }
        return {};
    }

    Expected<void> add(const fs::path& file, const Expected<void>& done) {
        if (done) {
            written_.files.push_back(file);
        }
        return done;
    }

    void say_what_is_lost() {
        bool openness = false;
        bool origin = false;
        for (const gaze::GazeSample& sample : trace_.samples) {
            for (const gaze::EyeRay& ray : sample.eyes) {
                openness = openness || ray.openness >= 0.0;
                origin = origin || ray.origin_m != glm::dvec3{0.0};
            }
        }
        if (openness) {
            written_.left_out.emplace_back("each eye's openness: the gaze is one for both eyes");
        }
        if (origin) {
            written_.left_out.emplace_back("each eye's place: the gaze is one for both eyes");
        }
    }

    const gaze::RecordingView& trace_;
    fs::path folder_;
    const BidsLabels& labels_;
    WrittenBids written_;
};

}  // namespace

Expected<WrittenBids> write_bids(const gaze::RecordingView& trace, const fs::path& folder,
                                 const BidsLabels& labels) {
    for (const std::string& label : {labels.subject, labels.task}) {
        if (!is_label(label)) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("'{}' is no label of BIDS: letters and digits alone", label)});
        }
    }
    const double rate_hz = trace.rate_hz();
    if (!(rate_hz > 0.0)) {
        return bad_input(fmt::format(
            "{}: fewer than two samples with known times have no rate, which BIDS asks for",
            trace.file));
    }
    std::size_t unknown = 0;
    for (const gaze::GazeSample& sample : trace.samples) {
        unknown += sample.sampled.known() ? 0U : 1U;
    }
    Expected<WrittenBids> written = Writer(trace, folder, labels).write(rate_hz);
    if (written && unknown > 0) {
        written->left_out.push_back(fmt::format("{} samples whose time nobody knows", unknown));
    }
    return written;
}

}  // namespace gazeloop::drivers
