#pragma once

namespace vibrocontact
{
  /// Rigid creep of body 1 against body 2 in steady rolling.
  struct Creepage
  {
    /// rolling speed V >= 0 [m/s]
    double speed = 10;
    /// (velocity of body 1 - velocity of body 2) / V along x and y [-]
    double longitudinal = 0, lateral = 0;
    /// relative rotation about +z over V [1/m]
    double spin = 0;
    /// velocity of body 1 - velocity of body 2 along x and y, beside the creepages [m/s]
    double sliding_x = 0, sliding_y = 0;
    /// rotation of body 1 - rotation of body 2 about +z, beside speed times spin [rad/s]
    double sliding_rotation = 0;

    /// Whether anything slides beside the creepages.
    bool slides() const { return sliding_x != 0 || sliding_y != 0 || sliding_rotation != 0; }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &speed &longitudinal &lateral &spin &sliding_x &sliding_y &sliding_rotation;
    }
  };
} // namespace vibrocontact
