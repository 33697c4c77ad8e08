#include "coupling/participant.hpp"
#include "soilSide.hpp"

namespace springWall
{
namespace
{
using namespace mpm::coupling;

class InProcess : public SoilSide
{
  public:
    InProcess(const std::filesystem::path& caseFolder, int threads) : soil_(caseFolder, {}, threads)
    {
        soil_.initialize();
    }
    double time() override { return soil_.time(); }
    void save() override { start_ = soil_.saveState(); }
    void restore() override { soil_.restoreState(start_); }
    SoilWindow advance(double window, double displacement) override
    {
        const double pose[7] = {displacement, 0, 0, 1, 0, 0, 0};
        double force[3];
        try
        {
            soil_.writeField("wall", FieldName::RigidPose, pose, window);
            const Advance advance = soil_.advance(window);
            if (advance.status == Status::discarded)
                throw SoilLost(advance.message);
        }
        catch (const CouplingError& error)
        {
            throw SoilLost(error.what());
        }
        soil_.windowAverage("wall", FieldName::Force, force);
        return {force[0], soil_.interfaceWork("wall")};
    }
    void accept() override { soil_.acceptWindow(); }
    void finish() override { soil_.finalize(); }

  private:
    mpm::Participant soil_;
    Snapshot start_;
};
} // namespace

std::unique_ptr<SoilSide> soilInProcess(const std::filesystem::path& caseFolder, int threads)
{
    return std::make_unique<InProcess>(caseFolder, threads);
}
} // namespace springWall
