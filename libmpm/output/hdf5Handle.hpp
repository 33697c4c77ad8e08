#pragma once
/// One handle of the HDF5 library, for hdf5File.cpp alone.
#include <hdf5.h>
#include <utility>

namespace mpm::output
{
/// Owns one HDF5 handle of any kind.
class Handle
{
  public:
    using Closer = herr_t (*)(hid_t);
    Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
    ~Handle()
    {
        if (id_ >= 0)
            closer_(id_);
    }
    Handle(Handle&& other) : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
    Handle& operator=(Handle&&) = delete;
    operator hid_t() const { return id_; }
    bool good() const { return id_ >= 0; }

  private:
    hid_t id_;
    Closer closer_;
};
} // namespace mpm::output
