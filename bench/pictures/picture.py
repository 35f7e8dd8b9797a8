# SPDX-License-Identifier: MIT
"""One panel of a picture in SVG, beside this file."""
import pathlib


class Picture:
    width, height, left, right, top, bottom = 440, 300, 56, 16, 52, 44

    def __init__(self, title, x, y, x_label="{:g}".format, y_label="{:g}".format):
        self.x, self.y, self.x_label, self.y_label = x, y, x_label, y_label
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
                      f'width="{self.width}" font-family="sans-serif" font-size="12" fill="#222">',
                      f'<rect width="{self.width}" height="{self.height}" fill="#fff"/>']
        self.text(self.left, 20, title, size=14)

    def at(self, x, y):
        return (round(self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * (self.width - self.left - self.right), 1),
                round(self.height - self.bottom
                      - (y - self.y[0]) / (self.y[1] - self.y[0]) * (self.height - self.top - self.bottom), 1))

    def text(self, x, y, words, anchor="start", size=12, colour="#222"):
        self.parts.append(f'<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="{size}" fill="{colour}">{words}</text>')

    def dot(self, x, y, colour):
        place = self.at(x, y)
        self.parts.append(f'<circle cx="{place[0]}" cy="{place[1]}" r="3" fill="{colour}"/>')

    def line(self, points, colour, dash="", width=1.5):
        path = " ".join(f"{a},{b}" for a, b in (self.at(x, y) for x, y in points))
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"'
                          + (f' stroke-dasharray="{dash}"' if dash else "") + "/>")

    def axes(self, xs, ys, x_name, y_name):
        for x in xs:
            place = self.at(x, self.y[0])
            self.text(place[0], place[1] + 16, self.x_label(x), "middle")
        for y in ys:
            self.line([(self.x[0], y), (self.x[1], y)], "#ddd", width=1)
            place = self.at(self.x[0], y)
            self.text(place[0] - 6, place[1] + 4, self.y_label(y), "end")
        self.line([(self.x[0], self.y[0]), (self.x[1], self.y[0])], "#222", width=1)
        self.text((self.left + self.width - self.right) / 2, self.height - 10, x_name, "middle")
        self.text(self.left, self.top - 12, y_name, size=11)

    def write(self, file):
        (pathlib.Path(__file__).resolve().parent / file).write_text("\n".join(self.parts + ["</svg>", ""]))
