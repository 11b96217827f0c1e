// An armchair of eight boxes, in millimetres: what a person might draw before thinking about a family of chairs.
// Front towards -y, standing on z = 0.
module leg() cube([45, 45, 410]);
module arm() cube([55, 395, 200]);

color("peru") {
  translate([-260, -230, 0]) leg();
  translate([215, -230, 0]) leg();
  translate([-260, 185, 0]) leg();
  translate([215, 185, 0]) leg();
}
// seat
color("tan") translate([-260, -230, 410]) cube([520, 460, 45]);
// back
color("tan") translate([-260, 185, 455]) cube([520, 45, 480]);
color("peru") {
  translate([-260, -210, 455]) arm();
  translate([205, -210, 455]) arm();
}
