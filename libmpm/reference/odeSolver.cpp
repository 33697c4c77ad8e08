#include "reference/odeSolver.hpp"

#include "base/error.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <utility>

namespace mpm::reference
{
namespace
{
void silent(int, const char*, const char*, char*, void*) {}

void check(int flag, const char* call)
{
    if (flag >= 0)
        return;
    char* name = CVodeGetReturnFlagName(flag);
    const std::string text = name;
    std::free(name);
    throw StepError(fmt::format("the reference solution failed: {} returned {}", call, text));
}
} // namespace

struct OdeSolver::Body
{
    RightHandSide rhs;
    OdeEvents events;
    sundials::Context context;
    N_Vector y = nullptr;
    SUNNonlinearSolver nonlinear = nullptr;
    void* cvode = nullptr;
    double t = 0;
    std::vector<double> values;
    long evaluations = 0;
    int standing = 0;          ///< steps in a row too short to change t
    std::exception_ptr thrown; ///< by the right-hand side: it must not pass through CVODE, which is C

    ~Body()
    {
        CVodeFree(&cvode);
        SUNNonlinSolFree(nonlinear);
        N_VDestroy(y);
    }

    static int callRhs(realtype t, N_Vector y, N_Vector rate, void* self)
    {
        auto* body = static_cast<Body*>(self);
        ++body->evaluations;
        double* out = N_VGetArrayPointer(rate);
        try
        {
            body->rhs(t, N_VGetArrayPointer(y), out);
        }
        catch (...)
        {
            body->thrown = std::current_exception();
            return -1;
        }
        const bool finite = std::all_of(out, out + N_VGetLength(rate), [](double x) { return std::isfinite(x); });
        return finite ? 0 : 1; // 1: CVODE may try a smaller step
    }
    static int callEvents(realtype t, N_Vector y, realtype* values, void* self)
    {
        static_cast<Body*>(self)->events.functions(t, N_VGetArrayPointer(y), values);
        return 0;
    }
    void keep()
    {
        const double* data = N_VGetArrayPointer(y);
        values.assign(data, data + values.size());
    }
};

OdeSolver::OdeSolver(std::size_t size, double relativeTolerance, double absoluteTolerance, RightHandSide rhs)
    : OdeSolver(relativeTolerance, std::vector<double>(size, absoluteTolerance), std::move(rhs))
{}

OdeSolver::OdeSolver(double relativeTolerance, const std::vector<double>& absoluteTolerances, RightHandSide rhs)
    : body_(std::make_unique<Body>())
{
    Body& b = *body_;
    const std::size_t size = absoluteTolerances.size();
    b.rhs = std::move(rhs);
    b.values.assign(size, 0);
    b.y = N_VNew_Serial(sunindextype(size), b.context);
    N_VConst(0, b.y);
    b.cvode = CVodeCreate(CV_ADAMS, b.context);
    b.nonlinear = SUNNonlinSol_FixedPoint(b.y, 0, b.context);
    if (!b.y || !b.cvode || !b.nonlinear)
        throw StepError("the reference solution failed: no memory for CVODE");
    check(CVodeSetErrHandlerFn(b.cvode, silent, nullptr), "CVodeSetErrHandlerFn");
    check(CVodeInit(b.cvode, Body::callRhs, 0, b.y), "CVodeInit");
    const N_Vector tolerances = N_VNew_Serial(sunindextype(size), b.context);
    std::copy(absoluteTolerances.begin(), absoluteTolerances.end(), N_VGetArrayPointer(tolerances));
    const int flag = CVodeSVtolerances(b.cvode, relativeTolerance, tolerances); // copies them
    N_VDestroy(tolerances);
    check(flag, "CVodeSVtolerances");
    check(CVodeSetUserData(b.cvode, &b), "CVodeSetUserData");
    check(CVodeSetNonlinearSolver(b.cvode, b.nonlinear), "CVodeSetNonlinearSolver");
    check(CVodeSetMaxNumSteps(b.cvode, 100000), "CVodeSetMaxNumSteps");
    check(CVodeSetMaxHnilWarns(b.cvode, -1), "CVodeSetMaxHnilWarns");
}

OdeSolver::~OdeSolver() = default;

void OdeSolver::restart(double t, const std::vector<double>& y, OdeEvents events)
{
    Body& b = *body_;
    b.events = std::move(events);
    b.t = t;
    b.standing = 0;
    std::copy(y.begin(), y.end(), N_VGetArrayPointer(b.y));
    b.keep();
    check(CVodeReInit(b.cvode, t, b.y), "CVodeReInit");
    const int count = int(b.events.directions.size());
    check(CVodeRootInit(b.cvode, count, count ? Body::callEvents : nullptr), "CVodeRootInit");
    if (count)
    {
        check(CVodeSetRootDirection(b.cvode, b.events.directions.data()), "CVodeSetRootDirection");
        check(CVodeSetNoInactiveRootWarn(b.cvode), "CVodeSetNoInactiveRootWarn");
    }
}

void OdeSolver::limitStep(double longest)
{
    check(CVodeSetMaxStep(body_->cvode, longest), "CVodeSetMaxStep");
}

OdeSolver::Stop OdeSolver::advance(double end)
{
    Body& b = *body_;
    check(CVodeSetStopTime(b.cvode, end), "CVodeSetStopTime");
    const double before = b.t;
    const int flag = CVode(b.cvode, end, b.y, &b.t, CV_ONE_STEP);
    if (b.thrown)
        std::rethrow_exception(std::exchange(b.thrown, nullptr));
    check(flag, "CVode");
    b.keep();
    b.standing = b.t > before ? 0 : b.standing + 1;
    if (b.standing > 100)
        throw StepError(fmt::format("the reference solution stands still at t = {:g}", b.t));
    if (flag == CV_ROOT_RETURN)
        return Stop::event;
    return flag == CV_TSTOP_RETURN || b.t >= end ? Stop::end : Stop::step;
}

double OdeSolver::time() const
{
    return body_->t;
}

const std::vector<double>& OdeSolver::state() const
{
    return body_->values;
}

std::vector<bool> OdeSolver::happened() const
{
    std::vector<int> flags(body_->events.directions.size());
    check(CVodeGetRootInfo(body_->cvode, flags.data()), "CVodeGetRootInfo");
    std::vector<bool> out(flags.size());
    std::transform(flags.begin(), flags.end(), out.begin(), [](int flag) { return flag != 0; });
    return out;
}

long OdeSolver::evaluations() const
{
    return body_->evaluations;
}
} // namespace mpm::reference
