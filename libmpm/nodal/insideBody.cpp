#include "nodal/insideBody.hpp"

namespace mpm::nodal
{
Intruders particlesInside(const ContactBody& body, const state::Particles& p, double h)
{
    Intruders out;
    out.depth = 1e-6 * h;
    for (Index i = 0; i < p.size(); ++i)
    {
        Vector3 x{};
        bool apart = false;
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
        {
            x[a] = p.x[a][std::size_t(i)];
            apart = apart || x[a] < body.low()[a] || x[a] > body.high()[a];
        }
        const double inside = apart ? 0 : -body.nearest(x).distance;
        out.count += inside > 1e-6 * h;
        if (inside > out.depth)
        {
            out.depth = inside;
            out.deepest = i;
        }
    }
    return out;
}
} // namespace mpm::nodal
