#pragma once

#include <deal.II/base/exceptions.h>

#include <petscsys.h>

#include <string>

namespace vibrocontact
{
  static_assert(sizeof(PetscInt) == sizeof(int),
                "MUMPS, METIS and our own arrays take PETSc's indices as int");

  /// Throws if a call of PETSc or SLEPc failed. For calls whose results are used afterwards.
  inline void petsc_check(const PetscErrorCode error, const char *const what)
  {
    AssertThrow(error == 0, dealii::ExcMessage(std::string(what) + " failed with code " +
                                               std::to_string(static_cast<int>(error)) + " of PETSc."));
  }
} // namespace vibrocontact
