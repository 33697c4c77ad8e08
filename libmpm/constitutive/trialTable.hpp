#pragma once
/// The return map row by row: trial stresses in, returned stresses out (driveLaw -trial).
///
/// Columns read: E_Pa, nu, c_Pa, phi_deg, psi_deg and tr_xx, tr_yy, tr_zz, tr_xy, tr_yz, tr_zx [Pa]. Columns written,
/// replaced where they are already there: region, ret_xx, ret_yy, ret_zz, ret_xy, ret_yz, ret_zx, with 17 significant
/// digits. All other columns pass through. Errors: InputError with file:line, what was found and what is allowed.
#include "base/csvTable.hpp"

namespace mpm::constitutive
{
void returnTrials(CsvTable& table);
} // namespace mpm::constitutive
