#include "constitutive/trialTable.hpp"

#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/singlePoint.hpp"

#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
struct Columns
{
    std::size_t young, poisson, cohesion, friction, dilation;
    std::array<std::size_t, 6> trial;
};

Columns findColumns(const CsvTable& table)
{
    Columns c{table.column("E_Pa"),    table.column("nu"),      table.column("c_Pa"),
              table.column("phi_deg"), table.column("psi_deg"), {}};
    for (int k = 0; k < 6; ++k)
        c.trial[k] = table.column(std::string("tr_") + stressNames[k]);
    return c;
}

MohrCoulombParameters readRow(const CsvTable& table, const CsvTable::Row& row, const Columns& c)
{
    const auto number = [&](std::size_t column, const dictionary::Bound& bound) {
        const double value = table.number(row, column);
        if (!bound.contains(value))
            table.fail(row, column, bound.text());
        return value;
    };
    using dictionary::Bound;
    MohrCoulombParameters p;
    p.moduli.young = number(c.young, Bound::positive());
    p.moduli.poisson = number(c.poisson, Bound::open(-1, 0.5));
    p.cohesion = number(c.cohesion, Bound::nonNegative());
    p.frictionAngle = number(c.friction, Bound::rightOpen(0, 90));
    p.dilationAngle = number(c.dilation, Bound::between(0, p.frictionAngle));
    return p;
}
} // namespace

void returnTrials(CsvTable& table)
{
    const Columns columns = findColumns(table);
    const std::size_t region = table.addColumn("region");
    std::array<std::size_t, 6> returned;
    for (int k = 0; k < 6; ++k)
        returned[k] = table.addColumn(std::string("ret_") + stressNames[k]);

    for (std::size_t i = 0; i < table.rows().size(); ++i)
    {
        const auto& row = table.rows()[i];
        const MohrCoulomb law(readRow(table, row, columns));
        SymmetricTensor trial;
        for (int k = 0; k < 6; ++k)
            trial[k] = table.number(row, columns.trial[k]);
        const PointStep out = returnMap(law, trial);
        table.set(i, region, regionName(out.region));
        for (int k = 0; k < 6; ++k)
            table.set(i, returned[k], fmt::format("{:.17g}", out.stress[k]));
    }
}
} // namespace mpm::constitutive
