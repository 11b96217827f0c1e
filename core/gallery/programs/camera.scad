// A camera, in millimetres, looking towards -y, standing on z = 0.

// body
color("dimgray") translate([-65, -20, 0]) cube([130, 40, 82]);
// grip
color("black") translate([-65, -40, 0]) cube([34, 20, 82]);
// lens
color("black") translate([14, -20, 41]) rotate([90, 0, 0]) cylinder(h = 58, d = 58);
// viewfinder
color("dimgray") translate([-6, -20, 82]) cube([40, 40, 20]);
