// A car, in millimetres at a scale of about 1 : 10, driving towards -y, standing on z = 0.
module wheel() rotate([0, 90, 0]) cylinder(h = 18, d = 62, center = true);

// hood
color("steelblue") translate([-80, -210, 25]) cube([160, 120, 50]);
// cabin
color("skyblue") translate([-80, -90, 25]) cube([160, 190, 110]);
// trunk
color("steelblue") translate([-80, 100, 25]) cube([160, 90, 50]);
for (x = [-89, 89]) {
  color("black") translate([x, -145, 31]) wheel();
  color("black") translate([x, 135, 31]) wheel();
}
