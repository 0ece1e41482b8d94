#pragma once

#include <vibrocontact/marching/drive.h>

namespace vibrocontact
{
  /// Hears of a held hub that jumps, anywhere within the steps (of longer runs, within 20,000 intervals): its acceleration,
  /// a difference over the step, would be a force on the modes of body 1 that grows with shorter steps without end. A jump is found if
  /// it is a tenth of what the hub moves in a sixteenth of a step, against that motion if it is larger than this.
  /// @throws InputError with the time of the jump. Collective.
  void check_hub_does_not_jump(const TransientParameters &transient);

  /// Hears what is wrong with the drive before anything expensive: makes it and looks at it at the ends of
  /// the run's steps, at most 20,000 of them, with the roughness at some hundred, and between them: what varies there by more than a
  /// fifth is refused (of adapted steps, between the shortest ones). Says in the log which load of
  /// section Rolling it replaces by the other kind.
  /// @throws InputError as drive_function() and what it makes. Collective.
  void check_drive(const TransientParameters &transient, const RollingCase &constant,
                   const PlacedContacts &contacts);
} // namespace vibrocontact
