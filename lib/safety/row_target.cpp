#include "safety/row_target.hpp"

namespace coordreq {

RowTarget::RowTarget(const CellSet& set, const RowSlices& last_slices, const GridDimension& last_dimension,
                     ThreadTeam& team)
    : set_(&set), ends_{last_dimension.below, last_dimension.above} {
  const auto set_bytes = static_cast<std::int64_t>(set.words().size() * sizeof(Word));
  for (const std::vector<RowSegment>& slice : last_slices.slices) {
    const bool simple = slice.size() == 1 && slice[0].kind == RowSegment::Kind::shifted;
    const bool fits = static_cast<std::int64_t>(windows_.size() + 1) * set_bytes <= kMaxBytes;
    position_.push_back(simple && fits ? static_cast<std::int32_t>(windows_.size()) : -1);
    if (simple && fits) windows_.push_back(slice[0].range);
  }
  eroded_.assign(windows_.size(), CellSet(set.rows(), set.row_length()));
  team.for_each(set.rows(), 256, [&](ThreadTeam::Range range, int) {
    RowEroder eroder;
    for (std::int64_t r = range.begin; r < range.end; ++r) refresh(r, eroder);
  });
}

void RowTarget::refresh(std::int64_t row, RowEroder& eroder) {
  const ConstRow source = set_->row(row);
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    eroder.erode(source, set_->row_length(), windows_[i].first, windows_[i].last, ends_, eroded_[i].row(row));
  }
}

}  // namespace coordreq
