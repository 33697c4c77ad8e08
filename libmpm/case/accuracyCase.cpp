#include "case/accuracyCase.hpp"

#include "base/hash.hpp"
#include "base/version.hpp"
#include "case/accuracyText.hpp"
#include "case/gridFromDict.hpp"
#include "case/readScene.hpp"
#include "case/readSchemes.hpp"
#include "case/runTime.hpp"
#include "output/csvSeries.hpp"
#include "output/replaceFile.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace mpm::cases
{
namespace fs = std::filesystem;
using dictionary::Dictionary;

namespace
{
constexpr const char* gridFile = "system/gridDict";
constexpr const char* seedFile = "system/seedParticlesDict";
constexpr const char* schemeFile = "system/mpmSchemes";
constexpr const char* controlFile = "system/controlDict";

std::string fileText(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in)
        throw InputError({file.string()}, "cannot be read");
    return text.str();
}

/// Which dictionary an axis changes.
const char* fileOf(const std::string& axis)
{
    return axis == "cellSize" ? gridFile : axis == "particlesPerCell" ? seedFile : schemeFile;
}

bool hasOrder(const std::string& transfer)
{
    return transfer == "XPIC" || transfer == "FMPM";
}

double fastestWave(const Dictionary& materialProperties)
{
    double fastest = 0;
    for (const auto& material : readMaterials(materialProperties))
        fastest = std::max(fastest, material.waveSpeed());
    return fastest;
}

std::string wordOr(const Dictionary& d, const std::string& word, const std::string& fallback)
{
    return d.get<std::string>({word, "", {}, {}, fallback});
}

/// The case's own value of every axis but the time step's.
Setting ownSetting(const CaseDirectory& folder)
{
    const auto grid = Dictionary::readFile(folder.dictionaryPath(gridFile));
    const auto seeds = Dictionary::readFile(folder.dictionaryPath(seedFile));
    const auto schemes = Dictionary::readFile(folder.dictionaryPath(schemeFile));
    Setting own;
    own["cellSize"] = output::shortest(grid.get<double>({"cellSize", ""}));
    own["particlesPerCell"] = fmt::format("{}", seeds.get<Index>({"particlesPerCell", "", {}, {}, Index(2)}));
    own["shape"] = wordOr(schemes, "shape", "uGIMP");
    own["transfer"] = wordOr(schemes, "transfer", "FLIP");
    own["stressUpdate"] = wordOr(schemes, "stressUpdate", "MUSL");
    own["timeIntegration"] = wordOr(schemes, "timeIntegration", "symplecticEuler");
    own["staggeredStart"] = schemes.get<bool>({"staggeredStart", "", {}, {}, false}) ? "yes" : "no";
    own["picRate"] = output::shortest(schemes.get<double>({"picRate", "", {}, {}, 0.0}));
    own["order"] = fmt::format("{}", schemes.get<Index>({"order", "", {}, {}, Index(2)}));
    own["splitting"] = schemes.found("splitting") ? "on" : "off";
    return own;
}
} // namespace

std::string textHash(const std::string& text)
{
    return fmt::format("{:016x}", hashOf(text));
}

AccuracyCase::AccuracyCase(const CaseDirectory& folder, bool storedTimes)
    : folder_(folder), storedTimes_(storedTimes), own_(ownSetting(folder))
{
    const auto control = Dictionary::readFile(folder.dictionaryPath(controlFile));
    const RunTime time(control);
    adjustable_ = time.adjustable();
    endTime_ = time.endTime();
    if (!(endTime_ > 0))
        control.fail("endTime", fmt::format("{:g} s", endTime_), "> 0: rows run from time 0");
    interval_ = endTime_;
    if (storedTimes && wordOr(control, "writeControl", "runTime") != "timeStep")
        interval_ = std::min(endTime_, control.get<double>({"writeInterval", ""}));
    const auto materials = Dictionary::readFile(folder.dictionaryPath("constant/materialProperties"));
    waveSpeed_ = fastestWave(materials);
    const auto gridDict = Dictionary::readFile(folder.dictionaryPath(gridFile));
    const auto grid = gridFromDict(gridDict);
    dim_ = grid.dim;
    courant_ = adjustable_ ? time.maxCo() : waveSpeed_ * time.deltaT() / grid.h;

    for (const auto& line : versionLines())
        baseText_ += line + "\n";
    baseText_ += storedTimes ? "stored times\n" : "end\n";
    std::vector<std::string> files{gridFile, seedFile, schemeFile, controlFile};
    for (const auto& entry : fs::directory_iterator(folder.folder() / "constant"))
        if (entry.is_regular_file())
            files.push_back("constant/" + entry.path().filename().string());
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
        baseText_ += file + "\n" + Dictionary::readFile(folder.dictionaryPath(file)).text();
    const auto seeds = Dictionary::readFile(folder.dictionaryPath(seedFile));
    baseText_ += fileText(folder.geometryPath(seeds.found("geometry") ? wordOr(seeds, "geometry", "") : ""));
}

fs::path AccuracyCase::rowFolder(const MatrixRow& row) const
{
    return folder_.folder() / "accuracyCost" / row.name;
}

std::string AccuracyCase::key(const MatrixRow& row) const
{
    std::string text = baseText_;
    for (const auto& [axis, value] : facts(row).effective)
        text += axis + " " + value + "\n";
    return textHash(text);
}

Setting AccuracyCase::effective(const MatrixRow& row) const
{
    Setting all = own_;
    for (const auto& [axis, value] : row.setting)
        all[axis] = value;
    if (!hasOrder(all["transfer"]))
        all.erase("order");
    if (all["transfer"] != "FLIP" && !row.setting.count("picRate"))
        all.erase("picRate");
    return all;
}

RowFacts AccuracyCase::facts(const MatrixRow& row) const
{
    RowFacts out;
    out.effective = effective(row);
    out.endTime = endTime_;
    out.cellSize = std::stod(out.effective.at("cellSize"));
    const auto given = [&](const std::string& axis) { return row.setting.count(axis) > 0; };
    out.courant = given("courant") ? std::stod(row.setting.at("courant")) : courant_;
    if (given("deltaT"))
        out.deltaT = std::stod(row.setting.at("deltaT"));
    else
        out.deltaT = out.courant * out.cellSize / waveSpeed_;
    const auto steps = Index(std::ceil(interval_ / out.deltaT - 1e-9)); // between the times that are compared
    out.deltaT = interval_ / double(steps);
    out.steps = Index(std::llround(endTime_ / out.deltaT));
    if (!adjustable_ || given("deltaT"))
        out.courant = waveSpeed_ * out.deltaT / out.cellSize;
    out.declared = out.effective;
    const bool byStep = given("deltaT");
    out.declared.erase(byStep ? "courant" : "deltaT");
    if (!byStep && !given("courant"))
        out.declared["courant"] = output::shortest(courant_);
    out.effective["courant"] = output::shortest(out.courant);
    out.effective["deltaT"] = output::shortest(out.deltaT);

    auto grid = Dictionary::readFile(folder_.dictionaryPath(gridFile));
    grid.set("cellSize", out.effective.at("cellSize"), fmt::format("row {}", row.name));
    try
    {
        const auto box = gridFromDict(grid);
        out.cells = box.cells[0] * box.cells[1] * box.cells[2];
        out.work =
            double(out.cells) * std::pow(std::stod(out.effective.at("particlesPerCell")), dim_) * double(out.steps);
    }
    catch (const InputError& error)
    {
        out.refused = error.what();
    }
    if (out.refused.empty())
        out.refused = refusedSchemes(row, out);
    if (out.effective.at("splitting") == "on" && own_.at("splitting") == "off")
        out.refused = "splitting on: the case has no dictionary `splitting` in system/mpmSchemes";
    if (row.setting.count("order") && !hasOrder(out.effective.at("transfer")))
        out.refused = "order: transfer " + out.effective.at("transfer") + " has none, XPIC and FMPM have";
    return out;
}

/// What the solver would say of the row's mpmSchemes; nothing where an #include keeps us from asking.
std::string AccuracyCase::refusedSchemes(const MatrixRow& row, const RowFacts& facts) const
{
    const auto text = changedText(schemeFile, row.setting, facts);
    if (text.find("#include") != std::string::npos)
        return "";
    try
    {
        const auto schemes = Dictionary::fromText(text, schemeFile);
        stepping::Scene scene;
        readSchemes(schemes, scene);
        readStressTreatment(schemes, scene); // what the laws may object to is not known here
        schemes.rejectUnread();
        return "";
    }
    catch (const InputError& error)
    {
        return error.what();
    }
}

std::string AccuracyCase::changedText(const std::string& file, const Setting& changes, const RowFacts& facts) const
{
    std::string text = fileText(folder_.dictionaryPath(file));
    for (const auto& [axis, value] : changes)
        if (axis != "splitting" && axis != "courant" && axis != "deltaT" && fileOf(axis) == file)
            text = replaceEntry(text, axis, value);
    if (file == schemeFile)
    {
        for (const std::string word : {"picRate", "order"})
            if (!facts.effective.count(word))
                text = removeEntry(text, word);
        if (facts.effective.at("splitting") == "off")
            text = removeEntry(text, "splitting");
    }
    if (file != controlFile)
        return text;
    for (const auto& [word, value] : {std::pair{"startFrom", "startTime"}, {"startTime", "0"}, {"purgeWrite", "0"}})
        text = replaceEntry(text, word, value);
    if (adjustable_ && changes.count("deltaT"))
        text = replaceEntry(text, "adjustTimeStep", "no");
    else if (adjustable_)
        text = replaceEntry(text, "maxCo", output::shortest(facts.courant));
    text = replaceEntry(text, "deltaT", output::shortest(facts.deltaT));
    if (!storedTimes_)
    {
        text = replaceEntry(text, "writeControl", adjustable_ ? "adjustableRunTime" : "runTime");
        text = replaceEntry(text, "writeInterval", output::shortest(endTime_));
    }
    return removeEntry(text, "recordStrain");
}

void AccuracyCase::make(const MatrixRow& row) const
{
    const fs::path target = rowFolder(row);
    fs::remove_all(target);
    output::makeFolder(target);
    for (const char* part : {"constant", "geometry"})
        if (fs::exists(folder_.folder() / part))
            fs::copy(folder_.folder() / part, target / part, fs::copy_options::recursive);
    output::makeFolder(target / "system");
    const RowFacts known = facts(row);
    for (const auto& entry : fs::directory_iterator(folder_.folder() / "system"))
    {
        const std::string file = "system/" + entry.path().filename().string();
        if (!entry.is_regular_file() || file == "system/accuracyCostDict")
            continue;
        std::ofstream out(target / file, std::ios::binary);
        if (!(out << changedText(file, row.setting, known) << std::flush))
            throw InputError({(target / file).string()}, "cannot be written (is the disk full?)");
    }
}
} // namespace mpm::cases
