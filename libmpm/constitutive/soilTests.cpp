#include "constitutive/soilTests.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::constitutive
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
SymmetricTensor plus(SymmetricTensor a, const SymmetricTensor& b)
{
    for (int k = 0; k < 6; ++k)
        a[k] += b[k];
    return a;
}

void append(std::vector<SoilTestPoint>& points, const SymmetricTensor& dStrain, const PointStep& step)
{
    const auto& last = points.back();
    points.push_back({plus(last.strain, dStrain), step.stress, step.region, last.plasticWork + step.plasticWork,
                      step.plasticStrain});
}

SymmetricTensor confined(const SoilTest& test, double ratio)
{
    const double vertical = -test.confiningStress;
    return {ratio * vertical, vertical, ratio * vertical, 0, 0, 0};
}

/// The lateral strain increment at which the lateral stress is that of the cell. The stress grows with the strain, by
/// pieces linearly: a secant step lands on the root once both points lie on its piece; a bracket keeps it from
/// straying.
SymmetricTensor lateralIncrement(const Law& law, const SoilTestPoint& from, double axial, double cell)
{
    const SymmetricTensor& stress = from.stress;
    const auto strains = [axial](double x) { return SymmetricTensor{x, axial, x, 0, 0, 0}; };
    const auto excess = [&](double x) {
        return updatePoint(law, stress, strains(x), from.strain, from.plasticStrain).stress[0] + cell;
    };
    const double nu = law.poissonRatio();
    const double size = std::max(cell, std::abs(stress[1])) + law.waveModulus() * std::abs(axial);

    double low = -nu * axial, high = low + 1e-3 * std::abs(axial), fLow = excess(low), fHigh = excess(high);
    for (double reach = std::abs(axial); fLow > 0 && reach < 1e3; reach *= 2)
        fLow = excess(low -= reach);
    for (double reach = std::abs(axial); fHigh < 0 && reach < 1e3; reach *= 2)
        fHigh = excess(high += reach);
    for (int i = 0; i < 200; ++i)
    {
        if (std::abs(fLow) <= 1e-13 * size)
            return strains(low);
        if (std::abs(fHigh) <= 1e-13 * size)
            return strains(high);
        const bool secant = i % 3 != 2 && fHigh != fLow;
        const double x = secant ? low - fLow * (high - low) / (fHigh - fLow) : 0.5 * (low + high);
        const double f = excess(x);
        if (x == low || x == high)
            break;
        (f < 0 ? low : high) = x;
        (f < 0 ? fLow : fHigh) = f;
    }
    return strains(std::abs(fLow) < std::abs(fHigh) ? low : high);
}

/// The strain (lateral, axial, lateral) from F = I to a confined stress: Newton's iteration with differences.
SymmetricTensor strainAt(const Law& law, const SymmetricTensor& stress)
{
    double lateral = 0, axial = 0;
    const auto stressAt = [&](double x, double y) { return updatePoint(law, {}, {x, y, x, 0, 0, 0}).stress; };
    const double size = std::max(std::abs(stress[0]), std::abs(stress[1])), d = 1e-7;
    for (int i = 0; i < 50; ++i)
    {
        const auto s = stressAt(lateral, axial);
        const double fx = s[0] - stress[0], fy = s[1] - stress[1];
        if (std::abs(fx) <= 1e-13 * size && std::abs(fy) <= 1e-13 * size)
            break;
        const auto dx = stressAt(lateral + d, axial), dy = stressAt(lateral, axial + d);
        const double xx = (dx[0] - s[0]) / d, xy = (dy[0] - s[0]) / d, yx = (dx[1] - s[1]) / d, yy = (dy[1] - s[1]) / d;
        const double det = xx * yy - xy * yx;
        if (i == 49 || !std::isfinite(det) || det == 0)
            throw InputError(
                fmt::format("{}: found no strain with the stress at the start, {:g} Pa along y and {:g} Pa "
                            "across; allowed is less",
                            law.name(), stress[1], stress[0]));
        lateral -= (yy * fx - xy * fy) / det;
        axial -= (xx * fy - yx * fx) / det;
    }
    return {lateral, axial, lateral, 0, 0, 0};
}

std::vector<SoilTestPoint> followTable(const Law& law, const SoilTest& test)
{
    const CsvTable table = CsvTable::read(test.path);
    std::array<std::size_t, 6> columns;
    for (int k = 0; k < 6; ++k)
        columns[k] = table.column(std::string("e") + stressNames[k]);
    std::vector<SoilTestPoint> points;
    SymmetricTensor former{};
    for (const auto& row : table.rows())
    {
        SymmetricTensor strain;
        for (int k = 0; k < 6; ++k)
            strain[k] = table.number(row, columns[k]);
        if (points.empty())
            points.push_back({strain, law.hyperelastic() ? updatePoint(law, {}, strain).stress : test.startStress,
                              Region::elastic, 0, 0});
        else
            for (Index i = 0; i < test.steps; ++i)
            {
                SymmetricTensor dStrain;
                for (int k = 0; k < 6; ++k)
                    dStrain[k] = (strain[k] - former[k]) / double(test.steps);
                append(
                    points, dStrain,
                    updatePoint(law, points.back().stress, dStrain, points.back().strain, points.back().plasticStrain));
            }
        former = points.back().strain = strain;
    }
    if (points.size() < 2)
        throw InputError({test.path, 0}, "found fewer than two rows, allowed is a path of at least two strains");
    return points;
}
} // namespace

const std::vector<dictionary::Choice>& soilTestCatalogue()
{
    static const std::vector<dictionary::Choice> tests = {
        {"oedometer", "axial strain, lateral strain zero"},
        {"triaxial", "drained axial compression at constant cell pressure"},
        {"simpleShear", "shear strain, normal strains zero"},
    };
    return tests;
}

std::string soilTestHelp()
{
    std::string text = "Paths (fixed axes, tension positive; large strains: logarithmic):\n";
    for (const auto& test : soilTestCatalogue())
        text += fmt::format("  {:<12} {}\n", test.name, test.help);
    return text +
           "  FILE.csv     total strains in columns exx, eyy, ezz, exy, eyz, ezx (tensor components)\n\n"
           "DICT is one material as in constant/materialProperties; it may hold the set-up of the test:\n"
           "  test\n  {\n"
           "    confiningStress 100e3;  // [Pa] compression at the start, cell pressure (oedometer: 0)\n"
           "    K0              0.7;    // lateral over vertical stress at the start (default nu/(1 - nu))\n"
           "    maxStrain       0.05;   // axial compression, or gamma = 2 exy (oedometer: 0.01)\n"
           "    steps           500;    // of the test; between the rows of a table: 1\n"
           "    startStress     (0 0 0 0 0 0);  // [Pa] xx yy zz xy yz zx, for a table\n  }\n\n"
           "Writes step, strains, stresses, meanStress, deviatorStress, volumetricStrain, plasticWork, region (and\n"
           "plasticStrain of a law that softens, as in a band referenceLength wide); the\n"
           "figure (.png, .svg) goes beside the table. -trial reads E_Pa, nu, c_Pa, phi_deg, psi_deg, tr_xx,\n"
           "tr_yy, tr_zz, tr_xy, tr_yz, tr_zx of each row and adds region, ret_xx ... ret_zx: Mohr-Coulomb's return.";
}

std::string requireSoilTest(const std::string& path)
{
    std::vector<std::string> names;
    for (const auto& test : soilTestCatalogue())
        names.push_back(test.name);
    if (std::find(names.begin(), names.end(), path) != names.end() || std::filesystem::is_regular_file(path))
        return path;
    const std::string near = nearestWord(path, names);
    throw InputError(fmt::format("-path: found '{}'{}, allowed {} or a table of strains", path,
                                 near.empty() ? "" : " (did you mean '" + near + "'?)", joinWords(names, ", ")));
}

const Dictionary& lawDictionary(const Dictionary& file, const std::string& material)
{
    if (material.empty() && file.found("law"))
        return file;
    std::vector<std::string> names;
    for (const auto& name : file.dictNames())
        if (name != "test")
            names.push_back(name);
    if (!material.empty() && std::find(names.begin(), names.end(), material) == names.end())
        throw InputError(file.where(), fmt::format("found no material {}, allowed is {}", material, joinWords(names)));
    if (material.empty() && names.size() != 1)
        throw InputError(file.where(), names.empty()
                                           ? "found no law, allowed is law NAME; and its parameters"
                                           : "found several materials, -material chooses one of " + joinWords(names));
    for (const auto& name : names)
        if (!material.empty() && name != material)
            file.passOver(name, "another material");
    return file.subDict(material.empty() ? names.front() : material);
}

SoilTest readSoilTest(const Dictionary& law, const std::string& path, double poisson, bool hyperelastic)
{
    const Dictionary none;
    const Dictionary* given = law.findDict("test", "set-up of the test driveLaw does");
    const Dictionary& d = given ? *given : none;
    const bool oedometer = path == "oedometer", triaxial = path == "triaxial", shear = path == "simpleShear";
    const bool table = !oedometer && !triaxial && !shear;

    SoilTest test;
    test.path = path;
    test.steps = d.get<Index>({"steps", "steps of the test, for a table between its rows", unit::none,
                               Bound::between(1, 1e7), Index(table ? 1 : 500)});
    const auto words = [&](bool wanted, const std::string& word, auto read) {
        if (wanted)
            read();
        else
            d.passOver(word, "set-up of another test");
    };
    words(!table, "confiningStress", [&] {
        test.confiningStress = d.get<double>({"confiningStress", "compression at the start, cell pressure",
                                              unit::pressure, Bound::nonNegative(), oedometer ? 0.0 : 100e3});
    });
    words(!table, "maxStrain", [&] {
        test.maxStrain = d.get<double>({"maxStrain", "axial compression, or gamma = 2 exy", unit::none,
                                        Bound::positive(), oedometer ? 0.01 : 0.05});
    });
    words(oedometer || shear, "K0", [&] {
        test.K0 = d.get<double>({"K0", "lateral over vertical stress at the start, default nu/(1 - nu)", unit::none,
                                 Bound::nonNegative(), poisson / (1 - poisson)});
    });
    words(table, "startStress", [&] {
        const auto values = d.get<std::vector<double>>({"startStress", "stress at the start, xx yy zz xy yz zx",
                                                        unit::pressure, Bound::any(), std::vector<double>(6, 0.0)});
        if (values.size() != 6)
            d.fail("startStress", fmt::format("{} numbers", values.size()), "6, (xx yy zz xy yz zx)");
        if (hyperelastic && values != std::vector<double>(6, 0.0))
            d.fail("startStress", "a stress", "zero: the stress of this law follows from the strains of the table");
        std::copy(values.begin(), values.end(), test.startStress.begin());
    });
    return test;
}

std::vector<SoilTestPoint> runSoilTest(const Law& law, const SoilTest& test)
{
    const bool oedometer = test.path == "oedometer", triaxial = test.path == "triaxial";
    if (!oedometer && !triaxial && test.path != "simpleShear")
        return followTable(law, test);

    std::vector<SoilTestPoint> points;
    const SymmetricTensor start = confined(test, triaxial ? 1 : test.K0);
    points.push_back({law.hyperelastic() ? strainAt(law, start) : SymmetricTensor{}, start, Region::elastic, 0, 0});
    const double step = test.maxStrain / double(test.steps);
    for (Index i = 0; i < test.steps; ++i)
    {
        const SoilTestPoint last = points.back();
        const SymmetricTensor dStrain = triaxial    ? lateralIncrement(law, last, -step, test.confiningStress)
                                        : oedometer ? SymmetricTensor{0, -step, 0, 0, 0, 0}
                                                    : SymmetricTensor{0, 0, 0, 0.5 * step, 0, 0};
        append(points, dStrain, updatePoint(law, last.stress, dStrain, last.strain, last.plasticStrain));
    }
    return points;
}

CsvTable soilTestTable(const std::vector<SoilTestPoint>& points, bool history)
{
    std::vector<std::string> columns{"step"};
    for (const char letter : {'e', 's'})
        for (const char* name : stressNames)
            columns.push_back(letter + std::string(name));
    for (const char* name : {"meanStress", "deviatorStress", "volumetricStrain", "plasticWork", "region"})
        columns.emplace_back(name);
    if (history)
        columns.emplace_back("plasticStrain");
    CsvTable table(columns);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto& [e, s, region, work, plasticStrain] = points[i];
        std::vector<std::string> cells{std::to_string(i)};
        const auto number = [&cells](double x) { cells.push_back(fmt::format("{:.17g}", x)); };
        std::for_each(e.begin(), e.end(), number);
        std::for_each(s.begin(), s.end(), number);
        const double p = (s[0] + s[1] + s[2]) / 3;
        double square = 0;
        for (int k = 0; k < 6; ++k)
            square += k < 3 ? (s[k] - p) * (s[k] - p) : 2 * s[k] * s[k];
        number(p);
        number(std::sqrt(1.5 * square));
        number(e[0] + e[1] + e[2]);
        number(work);
        cells.push_back(regionName(region));
        if (history)
            number(plasticStrain);
        table.addRow(std::move(cells));
    }
    return table;
}
} // namespace mpm::constitutive
