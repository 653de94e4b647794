#include "drivers/trace/clock/rows_read.h"

namespace gazeloop::drivers {

RowsRead::RowsRead() : kept_(std::make_shared<memory::Spool<KeptRow>>()), reader_(*kept_) {}

RowsRead::RowsRead(std::span<const TraceRow> rows) : RowsRead() {
    reserve(rows.size());
    for (const TraceRow& row : rows) {
        add(row);
    }
}

void RowsRead::add(const TraceRow& row) {
    clocks_.push_back(row);
    kept_->add(KeptRow(row));
}

}  // namespace gazeloop::drivers
