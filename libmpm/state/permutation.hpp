#pragma once
/// Moves columns into another order in place: new[i] = old[order[i]].
///
/// Most particles of a sort stay near their place. A column is rewritten piece by piece from a ring that holds what was
/// in the pieces around, so that it is read and written once and all else stays in the nearest cache; who comes from
/// farther away is put aside first. Pieces where nobody moves are left alone. Covered by tests/unit/particleOrder.cpp.
#include "state/particles.hpp"

namespace mpm::state
{
/// From here on sorting is worth a second thread.
inline constexpr Index manyParticles = 20000;

class Permutation
{
  public:
    explicit Permutation(Order order);

    /// T: float, double, std::int32_t, std::int64_t. `kept` is memory to work in, in any state.
    template <class T>
    void move(Column<T>& column, Column<T>& kept) const;

    /// Most come from far away: a thread would need a copy of the column for itself.
    bool scatters() const { return 4 * strangers_.size() > from_.size(); }

  private:
    static constexpr std::size_t piece = 512, reach = 3, ring = 4096; // ring >= (2 reach + 1) pieces, a power of two

    Order from_;                ///< of each place: where in the ring, or behind it among the strangers
    Order strangers_;           ///< those who come from more than `reach` pieces away
    std::vector<char> changes_; ///< of each piece: does anybody in it move?
    std::vector<char> wanted_;  ///< does a piece within reach change?
};
} // namespace mpm::state
