#include "solver/contact/blocks/factor_structure.hpp"

#include <algorithm>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

#include <cholmod.h>

#include "assembly/base/error.hpp"

namespace cupola {

namespace {

using Index = SuiteSparse_long;

/// CHOLMOD's analysis of a block pattern; owns its memory.
class Analysis {
 public:
  explicit Analysis(const BlockPattern& pattern);
  ~Analysis();
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const cholmod_factor& factor() const { return *L_; }

 private:
  void throw_if_out_of_memory() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  }
  cholmod_common common_;
  cholmod_sparse* graph_ = nullptr;
  cholmod_factor* L_ = nullptr;
};

/// Nested dissection. METIS draws from rand(), of which the process has one sequence, and starts that
/// sequence anew in each call: two calls at once would take numbers from each other.
bool dissect(cholmod_sparse* graph, std::vector<Index>* order, cholmod_common* common) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  return cholmod_l_metis(graph, nullptr, 0, 1, order->data(), common) != 0;
}

Analysis::Analysis(const BlockPattern& pattern) {
  cholmod_l_start(&common_);
  common_.print = 0;
  common_.try_catch = 1;  // a failure is reported by the status, not on stderr
  common_.supernodal = CHOLMOD_SUPERNODAL;
  // Columns that join a panel although zeros are then stored. CHOLMOD counts scalar columns, ours have six.
  common_.nrelax[0] = 1;
  common_.nrelax[1] = 4;
  common_.nrelax[2] = 8;
  const Index nb = pattern.num_blocks();
  graph_ = cholmod_l_allocate_sparse(nb, nb, pattern.num_pairs(), 1, 1, -1, CHOLMOD_PATTERN, &common_);
  throw_if_out_of_memory();
  std::copy(pattern.column_start.begin(), pattern.column_start.end(), static_cast<Index*>(graph_->p));
  std::copy(pattern.row.begin(), pattern.row.end(), static_cast<Index*>(graph_->i));

  std::vector<Index> order(nb);
  const bool ordered = pattern.num_pairs() > 0 && dissect(graph_, &order, &common_);
  throw_if_out_of_memory();
  if (!ordered) std::iota(order.begin(), order.end(), Index{0});  // no pairs to order
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 1;
  L_ = cholmod_l_analyze_p(graph_, order.data(), nullptr, 0, &common_);
  throw_if_out_of_memory();
  CUPOLA_ASSERT(L_ != nullptr);
}

Analysis::~Analysis() {
  cholmod_l_free_sparse(&graph_, &common_);
  cholmod_l_free_factor(&L_, &common_);
  cholmod_l_finish(&common_);
}

void set_order(const cholmod_factor& L, FactorStructure* f) {
  f->block.assign(static_cast<const Index*>(L.Perm), static_cast<const Index*>(L.Perm) + L.n);
  f->position.resize(L.n);
  for (std::size_t k = 0; k < L.n; ++k) f->position[f->block[k]] = static_cast<int>(k);
}

/// Panels are CHOLMOD's supernodes; wide ones are divided.
void set_panels(const cholmod_factor& L, FactorStructure* f) {
  const auto* first_column = static_cast<const Index*>(L.super);
  const auto* row_start = static_cast<const Index*>(L.pi);
  const auto* row = static_cast<const Index*>(L.s);
  f->row_start = f->value_start = {0};
  for (std::size_t k = 0; k < L.nsuper; ++k) {
    const Index width = first_column[k + 1] - first_column[k];
    for (Index begin = 0; begin < width; begin += FactorStructure::kPanelWidth) {
      f->first_column.push_back(static_cast<int>(first_column[k] + begin));
      f->row.insert(f->row.end(), row + row_start[k] + begin, row + row_start[k + 1]);
      const Index columns = std::min<Index>(FactorStructure::kPanelWidth, width - begin);
      f->row_start.push_back(std::ssize(f->row));
      f->value_start.push_back(f->value_start.back() + columns * (row_start[k + 1] - row_start[k] - begin));
    }
  }
  f->first_column.push_back(static_cast<int>(L.n));
}

std::vector<int> panels_of_columns(const FactorStructure& f) {
  std::vector<int> panel(f.position.size());
  for (int k = 0; k < f.num_panels(); ++k)
    std::fill(panel.begin() + f.first_column[k], panel.begin() + f.first_column[k + 1], k);
  return panel;
}

/// Groups items (key, value) by key and keeps their order.
template <class Item>
void group(int num_keys, const std::vector<std::pair<int, Item>>& items, std::vector<std::int64_t>* start,
           std::vector<Item>* grouped) {
  start->assign(num_keys + 1, 0);
  for (const auto& [key, item] : items) ++(*start)[key + 1];
  std::partial_sum(start->begin(), start->end(), start->begin());
  grouped->resize(items.size());
  std::vector<std::int64_t> next(start->begin(), start->end() - 1);
  for (const auto& [key, item] : items) (*grouped)[next[key]++] = item;
}

void set_entries(const BlockPattern& pattern, const std::vector<int>& panel_of_column, FactorStructure* f) {
  std::vector<std::pair<int, FactorStructure::Entry>> entries;
  entries.reserve(pattern.num_pairs());
  for (int block = 0; block < pattern.num_blocks(); ++block) {
    for (int pair = pattern.column_start[block]; pair < pattern.column_start[block + 1]; ++pair) {
      const int here = f->position[block], there = f->position[pattern.row[pair]];
      const auto [column, row] = std::minmax(here, there);
      const int panel = panel_of_column[column];
      const int* rows = f->rows(panel);
      const auto at = std::lower_bound(rows, rows + f->num_rows(panel), row) - rows;
      CUPOLA_ASSERT(at < f->num_rows(panel) && rows[at] == row);
      entries.push_back({column, {static_cast<int>(at), pair, there < here}});
    }
  }
  group(pattern.num_blocks(), entries, &f->entry_start, &f->entries);
}

void set_updates(const std::vector<int>& panel_of_column, FactorStructure* f) {
  std::vector<std::pair<int, FactorStructure::Update>> updates;
  for (int source = 0; source < f->num_panels(); ++source) {
    const int* rows = f->rows(source);
    const int num_rows = f->num_rows(source);
    for (int first = f->num_columns(source), last = first; first < num_rows; first = last) {
      const int target = panel_of_column[rows[first]];
      while (last < num_rows && panel_of_column[rows[last]] == target) ++last;
      updates.push_back({target, {source, first, last}});
    }
  }
  group(f->num_panels(), updates, &f->update_start, &f->updates);
}

/// Panels are in postorder, so the panels of a subtree are consecutive.
void set_subtrees(const std::vector<int>& panel_of_column, FactorStructure* f) {
  constexpr double kLargestShare = 1.0 / 16.0;  // of the work, in one subtree
  const int n = f->num_panels();
  std::vector<double> work(n);
  std::vector<int> first(n), parent(n, n);
  for (int k = 0; k < n; ++k) {
    const double rows = f->num_rows(k), columns = f->num_columns(k);
    work[k] = columns * rows * (rows - columns) + columns * columns * columns / 3.0;
    first[k] = k;
    if (f->num_rows(k) > f->num_columns(k)) parent[k] = panel_of_column[f->rows(k)[f->num_columns(k)]];
  }
  f->work = std::accumulate(work.begin(), work.end(), 0.0);
  for (int k = 0; k < n; ++k) {
    if (parent[k] == n) continue;
    work[parent[k]] += work[k];
    first[parent[k]] = std::min(first[parent[k]], first[k]);
  }
  for (int k = n - 1; k >= 0; --k) {
    if (work[k] > kLargestShare * f->work) {
      f->top.push_back(k);
    } else {
      f->subtrees.push_back({first[k], k + 1});
      k = first[k];
    }
  }
  std::reverse(f->top.begin(), f->top.end());
  std::ranges::stable_sort(f->subtrees, std::greater<>(),
                           [&](const FactorStructure::Subtree& tree) { return work[tree.last - 1]; });
}

/// The panels of a subtree reach only those rows beyond it that its last panel has.
void set_targets(FactorStructure* f) {
  const auto nb = static_cast<int>(f->position.size());
  f->target = f->row;
  std::vector<int> sum(nb);  // of the present subtree, at the positions that it reaches
  for (const FactorStructure::Subtree& tree : f->subtrees) {
    const int last = tree.last - 1, end = f->first_column[tree.last];
    for (int i = f->num_columns(last); i < f->num_rows(last); ++i) {
      sum[f->rows(last)[i]] = nb + static_cast<int>(f->top_row.size());
      f->top_row.push_back(f->rows(last)[i]);
    }
    for (auto k = f->row_start[tree.first]; k < f->row_start[tree.last]; ++k)
      if (f->row[k] >= end) f->target[k] = sum[f->row[k]];
  }
  for (int k = 0; k < f->num_panels(); ++k) f->most_rows = std::max(f->most_rows, f->num_rows(k));
}

FactorStructure analyze_anew(const BlockPattern& pattern) {
  FactorStructure f;
  {
    const Analysis analysis(pattern);
    set_order(analysis.factor(), &f);
    set_panels(analysis.factor(), &f);
  }
  const std::vector<int> panel_of_column = panels_of_columns(f);
  set_entries(pattern, panel_of_column, &f);
  set_updates(panel_of_column, &f);
  set_subtrees(panel_of_column, &f);
  set_targets(&f);
  return f;
}

}  // namespace

FactorStructure analyze(const BlockPattern& pattern) {
  CUPOLA_ASSERT(pattern.num_blocks() >= 0 && pattern.column_start.back() == pattern.num_pairs());
  constexpr int kMostBlocks = 10000;  // large structures take much memory
  struct Analyzed {
    BlockPattern pattern;
    FactorStructure structure;
  };
  thread_local std::optional<Analyzed> last;
  if (last && last->pattern == pattern) return last->structure;
  last.reset();
  FactorStructure structure = analyze_anew(pattern);
  if (pattern.num_blocks() <= kMostBlocks) last = Analyzed{pattern, structure};
  return structure;
}

}  // namespace cupola
