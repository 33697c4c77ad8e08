#pragma once
/// Takes standard output and standard error away from the whole process for the length of a scope: OpenCASCADE prints
/// whatever gmsh is told. Not for use while other threads print.
namespace mpm::geometry
{
class Silence
{
  public:
    Silence();
    ~Silence();
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

  private:
    int saved_[2] = {-1, -1};
};
} // namespace mpm::geometry
