#pragma once

#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/sweep_cases.h>

namespace vibrocontact
{
  /// What the analyses would refuse of files and entries although each by itself is valid, found before anything is
  /// computed: the road and the contact points of a modal convolution (bodies whose poles cost nothing are made), the
  /// rim of a wheel, the frequencies of data. Collective.
  /// @throws InputError
  void check_before_run(const Parameters &parameters, const MeshedBodies &bodies,
                        const std::optional<MeasuredData> &measured);

  /// What has to be read or made to be checked, but takes no time: expressions and tables of the drive
  /// (check_drive()), and the name of the perturbed mode if the modes of its body are in the cache.
  /// Collective.
  /// @throws InputError
  void check_transient_files(const Parameters &parameters, const MeshedBodies &bodies);

  /// The same for what needs meshes and matrices, which `--check` makes for it: places of points and probes, contact
  /// surfaces of the cases of sweeps. Collective.
  /// @throws InputError
  void check_places(const Parameters &parameters, const MeshedBodies &bodies,
                    const std::vector<SweepCases> &sweeps);
} // namespace vibrocontact
