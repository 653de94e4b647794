#include "runtime/session/session_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "runtime/session/column_names.h"
#include "runtime/session/database.h"
#include "runtime/session/record_fields.h"
#include "runtime/session/schema.h"
#include "runtime/session/statement.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {
namespace {

auto find(const std::vector<NamedValue>& values, std::string_view name) {
    return std::find_if(values.begin(), values.end(),
                        [name](const NamedValue& value) { return value.name == name; });
}

std::optional<std::string_view> value_of(const std::vector<NamedValue>& values,
                                         std::string_view name) {
    const auto found = find(values, name);
    return found == values.end() ? std::nullopt : std::optional<std::string_view>(found->value);
}

std::vector<NamedValue> read_named_values(const Database& database, std::string_view table) {
    std::vector<NamedValue> values;
    TableReader reader(database, table, "position", named_value_columns(), kSchemaVersion);
    while (reader.next()) {
        NamedValue& value = values.emplace_back();
        visit_named_value(reader, value.name, value.value);
    }
    return values;
}

/// Removes and returns what the recorder itself keeps in meta.
std::string take(std::vector<NamedValue>& meta, std::string_view name) {
    const auto found = find(meta, name);
    if (found == meta.end()) {
        throw FormatError(fmt::format("not a session: table meta has no {}", name));
    }
    std::string value = found->value;
    meta.erase(found);
    return value;
}

template <typename T>
T take_number(std::vector<NamedValue>& meta, std::string_view name) {
    const std::string text = take(meta, name);
    T number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{} || stop != end) {
        throw FormatError(fmt::format("table meta: {} is '{}', which is no number", name, text));
    }
    return number;
}

frame::NameList take_names(const std::string& text, std::string_view name, std::size_t most) {
    auto names = frame::NameList::parse(text, most);
    if (!names) {
        throw FormatError(fmt::format("table meta: {} is {}", name, names.error().message));
    }
    return *std::move(names);
}

std::vector<RecordedSample> read_samples(const Database& database, int version) {
    std::vector<RecordedSample> samples;
    TableReader reader(database, "gaze", "position", sample_columns(), version);
    while (reader.next()) {
        RecordedSample sample;
        visit_sample(reader, sample.frame, sample.sample);
        if (!samples.empty() && sample.frame < samples.back().frame) {
            reader.fail("was consumed by an earlier frame than the sample before it");
        }
        samples.push_back(sample);
    }
    return samples;
}

/// Moves to the row of one eye in one frame, which must be the next one, and reads it.
template <typename Visit>
void read_eye(TableReader& reader, std::uint64_t frame, gaze::Eye eye, const Visit& visit) {
    std::uint64_t row_frame = 0;
    gaze::Eye row_eye{};
    const bool more = reader.next();
    if (more) {
        visit(row_frame, row_eye);
    }
    if (!more || row_frame != frame || row_eye != eye) {
        reader.fail(fmt::format("the {} eye of frame {} is missing here",
                                gaze::kEyeNames[gaze::index(eye)], frame));
    }
}

std::vector<RecordedFrame> read_frames(const Database& database, int version) {
    std::vector<RecordedFrame> frames;
    TableReader rows(database, "frame", "number", whole_frame_columns(), version);
    TableReader views(database, "view", "frame, eye", view_columns(), version);
    TableReader foveae(database, "fovea", "frame, eye", fovea_columns(), version);
    while (rows.next()) {
        auto& [frame, gpu] = frames.emplace_back();
        visit_frame(rows, frame);
        gpu.index = frame.index;
        if (!rows.at_null()) {
            visit_gpu(rows, gpu);
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            auto& view = frame.views[gaze::index(eye)];
            read_eye(views, frame.index, eye, [&](auto& row_frame, auto& row_eye) {
                visit_view(views, row_frame, row_eye, view);
            });
            auto& fovea = frame.fovea.eyes[gaze::index(eye)];
            read_eye(foveae, frame.index, eye, [&](auto& row_frame, auto& row_eye) {
                visit_fovea(foveae, row_frame, row_eye, fovea);
            });
        }
    }
    for (TableReader* reader : {&views, &foveae}) {
        if (reader->next()) {
            reader->fail("belongs to no frame");
        }
    }
    // SQLite's order is that of signed numbers.
    std::sort(frames.begin(), frames.end(), [](const RecordedFrame& a, const RecordedFrame& b) {
        return a.frame.index < b.frame.index;
    });
    return frames;
}

std::vector<RecordedEvent> read_events(const Database& database, int version) {
    std::vector<RecordedEvent> events;
    TableReader reader(database, "event", "position", event_columns(), version);
    while (reader.next()) {
        RecordedEvent& event = events.emplace_back();
        visit_event(reader, event.time, event.kind, event.text);
    }
    return events;
}

std::vector<gaze::HiddenChange> read_hidden(const Database& database, int version) {
    std::vector<gaze::HiddenChange> changes;
    if (!has_table(database, kHiddenTable)) {
        return changes;
    }
    std::shared_ptr<gaze::PerEye<gaze::HiddenMesh>> meshes;
    TableReader reader(database, kHiddenTable, "position", hidden_columns(), version);
    while (reader.next()) {
        std::uint64_t frame = 0;
        gaze::Eye eye{};
        gaze::HiddenTriangle triangle;
        visit_hidden(reader, frame, eye, triangle);
        if (changes.empty() || frame != changes.back().frame) {
            if (!changes.empty() && frame < changes.back().frame) {
                reader.fail("is of an earlier frame than the row before it");
            }
            meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
            changes.push_back({frame, meshes});
        }
        if (!std::isnan(triangle.corners[0].x)) {
            (*meshes)[gaze::index(eye)].push_back(triangle);
        }
    }
    return changes;
}

/// An empty one may be SQLite's own, for reading.
bool has_write_ahead_log(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file.string() + "-wal", error);
    return !error && bytes > 0;
}

/// SQLite fills up a last page that is cut off with zeros, which would pass for data.
void require_whole_pages(const Database& database, const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    Statement page_size(database, "PRAGMA page_size");
    if (error || !page_size.next() ||
        bytes % static_cast<std::uintmax_t>(page_size.integer(0)) != 0) {
        throw FormatError("is cut off; copy it again");
    }
}

SessionFile read_tables(const Database& database) {
    SessionFile session;
    std::vector<NamedValue>& meta = session.header.meta;
    meta = read_named_values(database, "meta");
    const int version = take_number<int>(meta, kMetaSchemaVersion);
    if (version > kSchemaVersion) {
        throw FormatError(fmt::format(
            "has schema version {}, and this program reads up to version {}; use a newer gazeloop",
            version, kSchemaVersion));
    }
    if (version < kOldestSchemaVersion) {
        throw FormatError(fmt::format(
            "has schema version {}, and this program reads versions from {} on; use an older "
            "gazeloop",
            version, kOldestSchemaVersion));
    }
    const bool named = version > 1;  // before, all runs had the same passes and grids
    session.header.passes = take_names(named ? take(meta, kMetaPasses) : std::string(kFormerPasses),
                                       kMetaPasses, frame::kMostPasses);
    session.header.grids = take_names(named ? take(meta, kMetaGrids) : std::string(kFormerGrids),
                                      kMetaGrids, frame::kMostGrids);
    session.records_dropped = take_number<std::uint64_t>(meta, kMetaRecordsDropped);
    const std::string closed = take(meta, kMetaClosed);
    session.closed_cleanly = closed == kClosed;
    session.writing_failed = closed == kWritingFailed;
    session.header.config = read_named_values(database, "config");
    session.header.device = read_named_values(database, "device");
    session.samples = read_samples(database, version);
    session.frames = read_frames(database, version);
    session.events = read_events(database, version);
    session.hidden = read_hidden(database, version);
    return session;
}

std::unexpected<Error> bad_input(const std::filesystem::path& file, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
}

}  // namespace

std::optional<std::string_view> SessionFile::meta(std::string_view name) const {
    return value_of(header.meta, name);
}

std::optional<std::string_view> SessionFile::config(std::string_view key) const {
    return value_of(header.config, key);
}

Expected<SessionFile> read_session(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        return bad_input(file, "does not exist");
    }
    if (!std::filesystem::is_regular_file(status)) {
        return bad_input(file, "is not a file");
    }
    if (!std::ifstream(file)) {
        return bad_input(file, "cannot be opened for reading");
    }
    if (!looks_like_session(file)) {
        return bad_input(file, "is not a session: no SQLite file");
    }
    try {
        Database database(file, Database::Access::ReadOnly);
        // One state of a file that is still being written, from its first read on.
        database.execute("BEGIN; SELECT 1 FROM sqlite_schema");
        const bool log = has_write_ahead_log(file);
        if (!log) {  // else the file itself may be unfinished
            require_whole_pages(database, file);
        }
        SessionFile session = read_tables(database);
        session.had_write_ahead_log = log;
        return session;
    } catch (const FormatError& format) {
        return bad_input(file, format.what());
    } catch (const DatabaseError& database) {
        const bool damaged = database.code() == SQLITE_CORRUPT || database.code() == SQLITE_NOTADB;
        return bad_input(
            file, damaged ? fmt::format("{}: it is cut short or damaged", database.what())
                          : fmt::format("{}; if {}-wal exists, copy both into a folder that can be "
                                        "written to",
                                        database.what(), file.filename().string()));
    }
}

bool looks_like_session(const std::filesystem::path& file) {
    constexpr std::string_view kMagic{"SQLite format 3\0", 16};
    std::array<char, kMagic.size()> begin{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(begin.data(), begin.size());
    return stream && std::string_view(begin.data(), begin.size()) == kMagic;
}

}  // namespace gazeloop::session
