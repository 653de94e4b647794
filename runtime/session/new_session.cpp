#include "runtime/session/new_session.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "runtime/session/column_names.h"
#include "runtime/session/database.h"
#include "runtime/session/field_binder.h"
#include "runtime/session/schema.h"
#include "runtime/session/statement.h"

namespace gazeloop::session {
namespace {

constexpr std::array<const char*, 3> kCompanions{"-wal", "-shm", "-journal"};

Error bad_input(std::string message) { return {ErrorKind::BadInput, std::move(message)}; }

Error exists_already(const std::filesystem::path& file) {
    return bad_input(
        fmt::format("{}: exists already; name another file or remove it", file.string()));
}

Error cannot_be_created(const std::filesystem::path& file, int error) {
    return bad_input(
        fmt::format("{}: cannot be created ({}); the folder must exist and be writable",
                    file.string(), std::generic_category().message(error)));
}

std::optional<Error> refuse_what_is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
        return exists_already(file);
    }
    // SQLite would delete what lies beside a session that was moved away, or take it for its own.
    for (const char* companion : kCompanions) {
        const std::filesystem::path beside = file.string() + companion;
        if (std::filesystem::exists(beside, ignored)) {
            return bad_input(
                fmt::format("{}: belongs to an earlier session; remove it or name another file",
                            beside.string()));
        }
    }
    return std::nullopt;
}

/// A new, empty file beside `file`, which is removed in the end.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& file)
        : name_(file.string() + ".partial-XXXXXX") {
        const int created = ::mkostemp(name_.data(), O_CLOEXEC);
        if (created < 0) {
            error_ = errno;
        } else {
            ::close(created);
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (error_ == 0) {
            remove_session(name_);
        }
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] int error() const { return error_; }  ///< why there is none, 0 if there is

  private:
    std::string name_;
    int error_ = 0;
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

void write_header(const std::filesystem::path& file, const SessionHeader& header) {
    Database database(file, Database::Access::ReadWrite);
    // A file that was left under its temporary name is never rolled back.
    database.execute("PRAGMA journal_mode = MEMORY; BEGIN");
    database.execute(kCreateTables);
    if (header.study) {
        database.execute(kCreateStudyTables);
    }
    insert_named_values(database, "meta",
                        {{std::string(kMetaSchemaVersion), std::to_string(kSchemaVersion)},
                         {std::string(kMetaRecordsDropped), "0"},
                         {std::string(kMetaClosed), std::string(kNotClosed)},
                         {std::string(kMetaPasses), header.passes.text()},
                         {std::string(kMetaGrids), header.grids.text()}});
    insert_named_values(database, "meta", rows_of(header.meta));
    insert_named_values(database, "config", header.config);
    insert_named_values(database, "device", header.device);
    // After the commit: a file that is copied without its companions is still a session.
    database.execute("COMMIT; PRAGMA journal_mode = WAL");
}

/// Renames unless `to` exists; returns the system's error, 0 if none.
int rename_to_new(const char* from, const char* to) {
    if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) {
        return 0;
    }
    if (errno != EINVAL && errno != ENOSYS) {
        return errno;
    }
    // A file system without that flag. The temporary name is removed later.
    return ::link(from, to) == 0 ? 0 : errno;
}

}  // namespace

std::optional<Error> refuse_session(const std::filesystem::path& file) {
    if (std::optional<Error> error = refuse_what_is_there(file)) {
        return error;
    }
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        return cannot_be_created(file, errno);
    }
    if (!std::filesystem::is_directory(folder)) {
        return cannot_be_created(file, ENOTDIR);
    }
    return std::nullopt;
}

std::optional<Error> create_session(const std::filesystem::path& file,
                                    const SessionHeader& header) {
    if (std::optional<Error> error = refuse_what_is_there(file)) {
        return error;
    }
    const TemporaryFile temporary(file);
    if (temporary.error() != 0) {
        return cannot_be_created(file, temporary.error());
    }
    try {
        write_header(temporary.name(), header);
    } catch (const std::exception& error) {
        return bad_input(fmt::format("{}: cannot be written: {}", file.string(), error.what()));
    }
    switch (const int error = rename_to_new(temporary.name().c_str(), file.c_str())) {
        case 0:
            return std::nullopt;
        case EEXIST:
            return exists_already(file);
        default:
            return cannot_be_created(file, error);
    }
}

void remove_session(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    for (const char* companion : kCompanions) {
        std::filesystem::remove(file.string() + companion, ignored);
    }
}

}  // namespace gazeloop::session
