#include "runtime/session/session_writer.h"

#include <sqlite3.h>

#include <optional>
#include <string>
#include <type_traits>

#include "runtime/session/column_names.h"
#include "runtime/session/record_fields.h"
#include "runtime/session/schema.h"

namespace gazeloop::session {
namespace {

/// Binds the fields of a record to a statement's parameters, in order (see record_fields.h).
class FieldBinder {
  public:
    explicit FieldBinder(Statement& statement) : statement_(statement) {}

    template <typename Field>
    void operator()(std::string_view, std::string_view, const Field& field) {
        bind(field);
        ++parameter_;
    }

  private:
    void bind(double value) { statement_.bind(parameter_, value); }
    void bind(std::string_view text) { statement_.bind(parameter_, text); }
    template <typename T>
        requires(std::is_integral_v<T> || std::is_enum_v<T>)
    void bind(T value) {
        statement_.bind(parameter_, static_cast<std::int64_t>(value));
    }
    template <typename T>
    void bind(const std::optional<T>& value) {
        if (value) {
            bind(*value);
        } else {
            statement_.bind_null(parameter_);
        }
    }

    Statement& statement_;
    int parameter_ = 0;
};

void insert_named_values(const Database& database, std::string_view table,
                         const std::vector<NamedValue>& values) {
    Statement insert(database, named_value_columns().insert_into(table));
    for (const auto& [name, value] : values) {
        FieldBinder binder(insert);
        visit_named_value(binder, name, value);
        insert.run();
    }
}

Database create_session(const std::filesystem::path& file, const SessionHeader& header) {
    Database database(file, Database::Access::ReadWrite);
    // Before the WAL: a file that is copied without its companions is still a session.
    database.execute("BEGIN");
    database.execute(kCreateTables);
    insert_named_values(database, "meta",
                        {{std::string(kMetaSchemaVersion), std::to_string(kSchemaVersion)},
                         {std::string(kMetaRecordsDropped), "0"},
                         {std::string(kMetaClosed), "no"}});
    insert_named_values(database, "meta", header.meta);
    insert_named_values(database, "config", header.config);
    insert_named_values(database, "device", header.device);
    database.execute("COMMIT");
    database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
    return database;
}

}  // namespace

SessionWriter::SessionWriter(const std::filesystem::path& file, const SessionHeader& header)
    : database_(create_session(file, header)),
      insert_sample_(database_, sample_columns().insert_into("gaze")),
      insert_frame_(database_, frame_columns().insert_into("frame")),
      update_gpu_(database_, gpu_columns().update("frame", "number")),
      insert_view_(database_, view_columns().insert_into("view")),
      insert_fovea_(database_, fovea_columns().insert_into("fovea")),
      insert_event_(database_, event_columns().insert_into("event")),
      set_meta_(database_, "UPDATE meta SET value = ? WHERE name = ?") {}

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
}

void SessionWriter::write_one(const latency::FrameRecord& record) {
    FieldBinder binder(insert_frame_);
    visit_frame(binder, record);
    insert_frame_.run();
    for (const gaze::Eye eye : gaze::kEyes) {
        FieldBinder view_binder(insert_view_);
        visit_view(view_binder, record.index, eye, record.views[gaze::index(eye)]);
        insert_view_.run();
        FieldBinder fovea_binder(insert_fovea_);
        visit_fovea(fovea_binder, record.index, eye, record.fovea.eyes[gaze::index(eye)]);
        insert_fovea_.run();
    }
}

void SessionWriter::write_one(const latency::FrameGpuRecord& record) {
    // Changes nothing if the frame itself was dropped, which has been counted.
    FieldBinder binder(update_gpu_);
    visit_gpu(binder, record);
    binder("", "", record.index);
    update_gpu_.run();
}

void SessionWriter::write_one(const EventRecord& record) {
    FieldBinder binder(insert_event_);
    const std::string_view kind = record.kind.view();
    const std::string_view text = record.text.view();
    visit_event(binder, record.time, kind, text);
    insert_event_.run();
}

void SessionWriter::set_meta(std::string_view name, std::string_view value) {
    set_meta_.bind(0, value);
    set_meta_.bind(1, name);
    set_meta_.run();
}

void SessionWriter::finish() {
    set_meta(kMetaClosed, "yes");
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    try {
        database_.execute("PRAGMA journal_mode = DELETE");
    } catch (const DatabaseError& error) {
        // Somebody reads the file: everything is in it, but its companions go with that reader.
        if (error.code() != SQLITE_BUSY && error.code() != SQLITE_LOCKED) {
            throw;
        }
    }
}

}  // namespace gazeloop::session
