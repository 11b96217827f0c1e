// A bottle with a cap, in millimetres, standing on z = 0.

// body
color("seagreen") cylinder(h = 130, d = 74);
// shoulder
color("olive") translate([0, 0, 130]) cylinder(h = 45, d1 = 74, d2 = 30);
// neck
color("olive") translate([0, 0, 175]) cylinder(h = 45, d = 30);
// cap
color("gold") translate([0, 0, 220]) cylinder(h = 18, d = 30);
