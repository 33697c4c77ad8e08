#include "case/strainRecorder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace mpm::cases
{
namespace
{
const std::vector<std::string> columns = {"particle", "time", "exx", "eyy", "ezz", "exy", "eyz",
                                          "ezx",      "sxx",  "syy", "szz", "sxy", "syz", "szx"};
const std::string memoryName = "strainPaths"; // in the provenance of a state

/// log A = 2 (Z + Z^3/3 + Z^5/5 ...), Z = (A - I)(A + I)^-1; A close to I, as the motion of one step is.
Eigen::Matrix3d logarithm(const Eigen::Matrix3d& A)
{
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d Z = (A - I) * (A + I).inverse(), square = Z * Z;
    Eigen::Matrix3d power = Z, sum = Z;
    for (int k = 3; k <= 15; k += 2)
    {
        power = power * square;
        sum += power / k;
    }
    return 2 * sum;
}
} // namespace

std::vector<Index> StrainRecorder::wanted(const dictionary::Dictionary& control)
{
    std::vector<Index> ids;
    if (const auto* d = control.findDict("recordStrain", "strain paths of chosen particles"))
        for (const double id : d->get<std::vector<double>>({"particles", "ids", {}, dictionary::Bound::nonNegative()}))
        {
            if (id != double(Index(id)))
                d->fail("particles", fmt::format("{:g}", id), "ids, which are whole numbers");
            ids.push_back(Index(id));
        }
    return ids;
}

StrainRecorder::StrainRecorder(std::vector<Index> ids, const state::State& state, const Location& where)
{
    for (const Index id : ids)
    {
        if (find(state, id) == state.particles.mass.size())
            throw InputError(where,
                             fmt::format("recordStrain: found no particle {}; ids are below {}", id, state.nextId));
        paths_.push_back({id, deformation(state, id), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()});
    }
}

std::size_t StrainRecorder::find(const state::State& state, Index id) const
{
    const auto& ids = state.particles.id;
    const auto end = ids.begin() + state.particles.size();
    const auto found = std::find(ids.begin(), end, id);
    return found == end ? state.particles.mass.size() : std::size_t(found - ids.begin());
}

Eigen::Matrix3d StrainRecorder::deformation(const state::State& state, Index id) const
{
    const std::size_t n = find(state, id);
    const int dim = state.particles.dim;
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
            F(i, j) = state.particles.F[i * dim + j][n];
    return F;
}

void StrainRecorder::open(const std::filesystem::path& file, const state::State& state,
                          std::optional<double> continueAt)
{
    const bool goesOn = continueAt && resumed_ && std::filesystem::exists(file);
    series_ = std::make_unique<output::CsvSeries>(file, columns, goesOn ? continueAt : std::nullopt, 1);
    for (auto& path : paths_)
        if (!goesOn)
        {
            path.frame = Eigen::Matrix3d::Identity();
            path.strain = Eigen::Matrix3d::Zero();
            write(state, path);
        }
}

void StrainRecorder::rehearse(const std::filesystem::path& memoryFile)
{
    series_ = std::make_unique<output::CsvSeries>(output::CsvSeries::rehearsal(memoryFile, columns, 1));
}

void StrainRecorder::remember(state::State& state) const
{
    std::string text;
    for (const auto& path : paths_)
    {
        text += std::to_string(path.id);
        for (const auto* matrix : {&path.frame, &path.strain})
            for (const double value : matrix->reshaped())
                text.append(" ").append(output::shortest(value));
        text += "\n";
    }
    state.provenance[memoryName] = text;
}

std::string StrainRecorder::recall(state::State& state)
{
    const std::string memory = state.provenance[memoryName];
    state.provenance.erase(memoryName);
    return memory;
}

void StrainRecorder::resume(const std::string& memory)
{
    std::istringstream stream(memory);
    auto paths = paths_;
    for (auto& path : paths)
    {
        Index id = 0;
        if (!(stream >> id) || id != path.id)
            return;
        for (auto* matrix : {&path.frame, &path.strain})
            for (double& value : matrix->reshaped())
            {
                std::string word;
                stream >> word;
                if (std::from_chars(word.data(), word.data() + word.size(), value).ec != std::errc() ||
                    !std::isfinite(value))
                    return;
            }
    }
    std::string more;
    if (stream >> more)
        return;
    paths_ = std::move(paths);
    resumed_ = true;
}

void StrainRecorder::synchronise() const
{
    series_->synchronise();
}

void StrainRecorder::before(const state::State& state)
{
    for (auto& path : paths_)
        path.F = deformation(state, path.id);
}

void StrainRecorder::after(const state::State& state)
{
    for (auto& path : paths_)
    {
        const Eigen::Matrix3d increment = logarithm(deformation(state, path.id) * path.F.inverse());
        const Eigen::Matrix3d W = 0.5 * (increment - increment.transpose()), I = Eigen::Matrix3d::Identity();
        const Eigen::Matrix3d dR = (I - 0.5 * W).inverse() * (I + 0.5 * W);
        path.frame = dR * path.frame;
        path.strain += path.frame.transpose() * (0.5 * (increment + increment.transpose())) * path.frame;
        write(state, path);
    }
}

void StrainRecorder::write(const state::State& state, const Path& path)
{
    const std::size_t n = find(state, path.id);
    const auto& s = state.particles.stress;
    const bool solid = state.particles.dim == 3;
    Eigen::Matrix3d sigma;
    const double yz = solid ? s[4][n] : 0, zx = solid ? s[5][n] : 0;
    sigma << s[0][n], s[3][n], zx, s[3][n], s[1][n], yz, zx, yz, s[2][n];
    sigma = path.frame.transpose() * sigma * path.frame;
    const auto& e = path.strain;
    series_->write({double(path.id), state.time, e(0, 0), e(1, 1), e(2, 2), e(0, 1), e(1, 2), e(2, 0), sigma(0, 0),
                    sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(2, 0)});
}
} // namespace mpm::cases
