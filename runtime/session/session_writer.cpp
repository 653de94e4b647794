#include "runtime/session/session_writer.h"

#include <sqlite3.h>

#include <string>

#include "runtime/session/column_names.h"
#include "runtime/session/field_binder.h"
#include "runtime/session/schema.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {
namespace {

constexpr std::string_view kSetMeta = "UPDATE meta SET value = ? WHERE name = ?";

Database open_session(const std::filesystem::path& file) {
    Database database(file, Database::Access::ReadWrite);
    database.execute("PRAGMA synchronous = NORMAL");
    return database;
}

}  // namespace

SessionWriter::SessionWriter(const std::filesystem::path& file)
    : database_(open_session(file)),
      insert_sample_(database_, sample_columns().insert_into("gaze")),
      insert_frame_(database_, frame_columns().insert_into("frame")),
      update_gpu_(database_, gpu_columns().update("frame", "number")),
      update_gaze_error_(database_, gaze_error_columns().update("frame", "number")),
      insert_view_(database_, view_columns().insert_into("view")),
      insert_fovea_(database_, fovea_columns().insert_into("fovea")),
      insert_event_(database_, event_columns().insert_into("event")),
      insert_hidden_(database_, hidden_columns().insert_into(kHiddenTable)),
      insert_origin_(database_, origin_columns().insert_into(kOriginTable)),
      set_meta_(database_, kSetMeta) {
    if (has_table(database_, kTrialTable)) {
        ColumnNames trial;
        ColumnNames response;
        const TrialRow of_trial;
        const ResponseRow of_response;
        visit_trial(trial, of_trial);
        visit_response(response, of_response);
        insert_trial_.emplace(database_, trial.insert_into(kTrialTable));
        insert_response_.emplace(database_, response.insert_into(kResponseTable));
    }
    // A log from the start: a program that is killed before its first record would leave what looks
    // like a copy without its log. SQLite writes no page whose bytes stay as they are.
    begin();
    set_meta(kMetaRecordsDropped, "");
    set_meta(kMetaRecordsDropped, "0");
    database_.execute("COMMIT");
}

void SessionWriter::begin() { database_.execute("BEGIN IMMEDIATE"); }

void SessionWriter::commit(std::uint64_t dropped) {
    if (dropped != dropped_written_) {
        set_meta(kMetaRecordsDropped, std::to_string(dropped));
        dropped_written_ = dropped;
    }
    database_.execute("COMMIT");
}

void SessionWriter::write(const Record& record) {
    std::visit([this](const auto& one) { write_one(one); }, record);
}

void SessionWriter::write_one(const SampleRecord& record) {
    FieldBinder binder(insert_sample_);
    visit_sample(binder, record.frame, record.sample);
    insert_sample_.run();
    gaze_.add(record.sample);
}

void SessionWriter::write_one(const frame::FrameRecord& record) {
    FieldBinder binder(insert_frame_);
    visit_frame(binder, record);
    visit_gaze_counts(binder, gaze_.counts());
    insert_frame_.run();
    gaze_.add(record);
    write_decided_errors();
    for (const gaze::Eye eye : gaze::kEyes) {
        FieldBinder view_binder(insert_view_);
        visit_view(view_binder, record.index, eye, record.views[gaze::index(eye)]);
        insert_view_.run();
        FieldBinder fovea_binder(insert_fovea_);
        visit_fovea(fovea_binder, record.index, eye, record.fovea.eyes[gaze::index(eye)]);
        insert_fovea_.run();
    }
}

void SessionWriter::write_one(const frame::FrameGpuRecord& record) {
    // Changes nothing if the frame itself was dropped, which has been counted.
    FieldBinder binder(update_gpu_);
    visit_gpu(binder, record);
    binder("", "", record.index);
    update_gpu_.run();
    gaze_.add(record);
}

void SessionWriter::write_decided_errors() {
    gaze_.take_decided([this](std::uint64_t frame, const std::optional<frame::GazeError>& error) {
        if (error) {
            FieldBinder binder(update_gaze_error_);
            visit_gaze_error(binder, *error);
            binder("", "", frame);
            update_gaze_error_.run();
        }
    });
}

void SessionWriter::write_one(const EventRecord& record) {
    FieldBinder binder(insert_event_);
    const std::string_view kind = record.kind.view();
    const std::string_view text = record.text.view();
    visit_event(binder, record.time, kind, text);
    insert_event_.run();
}

void SessionWriter::write_one(const HiddenRecord& record) {
    FieldBinder binder(insert_hidden_);
    visit_hidden(binder, record.frame, record.eye, record.triangle);
    insert_hidden_.run();
}

void SessionWriter::write_one(const gaze::OriginChange& record) {
    FieldBinder binder(insert_origin_);
    visit_origin(binder, record);
    insert_origin_.run();
    gaze_.move_origin(record.new_in_old);
}

void SessionWriter::write_one(const TrialRecord& record) {
    FieldBinder binder(*insert_trial_);
    visit_trial(binder, record);
    insert_trial_->run();
}

void SessionWriter::write_one(const ResponseRecord& record) {
    FieldBinder binder(*insert_response_);
    visit_response(binder, record);
    insert_response_->run();
}

void SessionWriter::set_meta(std::string_view name, std::string_view value) {
    set_meta_.bind(0, value);
    set_meta_.bind(1, name);
    set_meta_.run();
}

void SessionWriter::mark_failed() {
    const auto mark = [this] {
        Statement set(database_, kSetMeta);  // the other one may be what failed
        set.bind(0, kWritingFailed);
        set.bind(1, kMetaClosed);
        set.run();
    };
    database_.roll_back();
    try {
        mark();
    } catch (const DatabaseError&) {
        // The log may have no room left for it; a checkpoint makes some.
        database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
        mark();
    }
}

void SessionWriter::finish() {
    gaze_.finish();
    begin();
    write_decided_errors();
    database_.execute("COMMIT");
    set_meta(kMetaClosed, kClosed);
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    try {
        // Out of WAL mode. Only the first sector changes, so a journal on disk would be of no use.
        // If a process killed here left one, it would keep readers out.
        database_.execute("PRAGMA journal_mode = MEMORY");
    } catch (const DatabaseError& error) {
        // Somebody reads the file. Everything is in it; its companions go when that reader ends.
        if (error.code() != SQLITE_BUSY && error.code() != SQLITE_LOCKED) {
            throw;
        }
    }
}

}  // namespace gazeloop::session
