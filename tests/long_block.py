"""A block of seven rows of contact points, of which a hollow counterpart touches the outer six: on one grid, or on two patches."""
from scene import entries, section

row = 2e-3
hollow_base = section("base", "set Type = rigid", section("Rigid", entries(Radius_x=-5, Radius_y=0)))


def block(divisions=5, modes=10, **material):
    """Held on top; `divisions` of its height."""
    return section("block", "set Type = block",
                   section("Block", entries(Length=7 * row, Width=row, Height=0.02, Divisions_x=7, Divisions_y=1,
                                            Divisions_z=divisions, Contact_face="bottom", Held="top")),
                   section("Material", entries(Young_modulus="1e10", Poisson_ratio=0.3, Density=1500, **material)),
                   section("Modes", entries(Count=modes)))


def one_grid(*sections, **contact):
    return section("Contact", entries(Grid_spacing=row, Strip_length=row, Half_length=3 * row, **contact), *sections)


def two_patches(front=None, **contact):
    """Contacts rear and front; `front`: entries that differ there."""
    return "\n".join(
        section(name, entries(Bodies="block, base", Origin=f"{x}, 0, 0", Grid_spacing=row, Strip_length=row, Half_length=row,
                              **{**contact, **own}))
        for name, x, own in (("rear", -2 * row, {}), ("front", 2 * row, front or {})))
