# Draws .ci/rooms.txt as an SVG picture: a frame for each folder, in it a box for each room, and arrows to the rooms
# that a room includes. Arrows that follow from others (a includes b, b includes c: a may include c) are left out.
#   sed ... .ci/rooms.txt | awk -F'|' -f .ci/rooms_picture.awk       (.ci/includes picture)

function folder_of(room) { sub(/\/.*/, "", room); return room }

function line(x1, y1, x2, y2, kind) {
    printf "<line class=\"%s\" x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" marker-end=\"url(#%s-head)\"/>\n", kind, x1, y1, x2, y2, kind
}

# Does room a include room b by another way through the folder's rooms, without the direct arrow?
function by_another(a, b,    k) {
    for (k = 1; k <= count; k++)
        if (includes[a, name[k]] && (includes[name[k], b] || by_another(name[k], b))) return 1
    return 0
}

BEGIN {
    box_width = 150; box_height = 34; gap = 26; row_gap = 12; margin = 14; head = 26
    # The folders: left and top of each frame, counted in columns of boxes and in rows of frames.
    split("tests:0:0 bench:0:1 app:3:1 python:7:1 run:3:2 parallel:0:3 io:4:3 core:0:4", places, " ")
    for (k in places) {
        split(places[k], part, ":")
        column_of[part[1]] = part[2]
        band_of[part[1]] = part[3]
    }
    # Arrows between folders that do not follow from others.
    arrow_count = split("tests>bench tests>app app>run python>run run>parallel run>io bench>parallel parallel>core io>core", folder_arrows, " ")
}

{
    name[++count] = $1
    folder = folder_of($1)
    if (!(folder in band_of)) { print "rooms_picture.awk: no place for folder " folder > "/dev/stderr"; failed = 1; exit 1 }
    level[$1] = 0
    n = split($3, allowed, " ")
    for (k = 1; k <= n; k++) {
        if (folder_of(allowed[k]) != folder || !(allowed[k] in level)) continue
        includes[$1, allowed[k]] = 1
        if (level[allowed[k]] >= level[$1]) level[$1] = level[allowed[k]] + 1
    }
    row[$1] = rows[folder, level[$1]]++
    if (rows[folder, level[$1]] > height[folder]) height[folder] = rows[folder, level[$1]]
    if (level[$1] + 1 > width[folder]) width[folder] = level[$1] + 1
}

END {
    if (failed) exit 1
    for (f in band_of) if (height[f] > band_rows[band_of[f]]) band_rows[band_of[f]] = height[f]
    top = margin
    for (b = 0; b < 5; b++) {
        band_top[b] = top
        top += head + band_rows[b] * (box_height + row_gap) + margin + 34
    }
    pitch = box_width + gap
    for (f in band_of) {
        left[f] = margin + column_of[f] * pitch + (f == "io" ? margin : f == "python" ? 2 * margin : 0)
        frame_width[f] = width[f] * pitch - gap + 2 * margin
        if (f == "run") frame_width[f] = 5 * pitch - gap + 2 * margin
        if (left[f] + frame_width[f] + margin > total) total = left[f] + frame_width[f] + margin
        frame_top[f] = band_top[band_of[f]]
        frame_height[f] = head + height[f] * (box_height + row_gap) - row_gap + margin
    }
    frame_width["core"] = frame_width["tests"] = total - 2 * margin
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\">\n", total, top - 20, total, top - 20
    print "<title>The rooms of Carom, and what includes what</title>"
    print "<style>"
    print ".page { fill: #ffffff } .frame { fill: #f3f5f8; stroke: #8b98a9 } .box { fill: #ffffff; stroke: #3b6ea5 }"
    print "text { fill: #1b2430; font-size: 14px } .folder { font-size: 15px; font-weight: bold }"
    print ".room { stroke: #3b6ea5; stroke-width: 1.3 } .whole { stroke: #5c6776; stroke-width: 3 }"
    print ".room-tip { fill: #3b6ea5 } .whole-tip { fill: #5c6776 }"
    print "@media (prefers-color-scheme: dark) {"
    print ".page { fill: #10151c } .frame { fill: #1a212b; stroke: #66758a } .box { fill: #10151c; stroke: #7fb2e8 }"
    print "text { fill: #e6ebf2 } .room { stroke: #7fb2e8 } .whole { stroke: #9aa7b8 }"
    print ".room-tip { fill: #7fb2e8 } .whole-tip { fill: #9aa7b8 }"
    print "}"
    print "</style>"
    print "<defs>"
    print "<marker id=\"room-head\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\"><path class=\"room-tip\" d=\"M0,0 L8,4 L0,8 z\"/></marker>"
    print "<marker id=\"whole-head\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"4\" markerHeight=\"4\" orient=\"auto\"><path class=\"whole-tip\" d=\"M0,0 L8,4 L0,8 z\"/></marker>"
    print "</defs>"
    printf "<rect class=\"page\" width=\"%d\" height=\"%d\"/>\n", total, top - 20
    for (p = 1; p <= arrow_count; p++) {
        split(folder_arrows[p], ends, ">")
        a = ends[1]; b = ends[2]
        # Straight down, in the middle of the width that both frames share.
        low = left[a] > left[b] ? left[a] : left[b]
        high = left[a] + frame_width[a] < left[b] + frame_width[b] ? left[a] + frame_width[a] : left[b] + frame_width[b]
        x = (low + high) / 2
        line(x, frame_top[a] + frame_height[a], x, frame_top[b] - 2, "whole")
    }
    for (f in band_of) order[++folders] = f
    for (p = 1; p <= folders; p++) for (q = p + 1; q <= folders; q++)
        if (order[q] < order[p]) { swap = order[p]; order[p] = order[q]; order[q] = swap }
    for (p = 1; p <= folders; p++) {
        f = order[p]
        printf "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"8\"/>\n", left[f], frame_top[f], frame_width[f], frame_height[f]
        printf "<text class=\"folder\" x=\"%d\" y=\"%d\">%s/</text>\n", left[f] + margin, frame_top[f] + 19, f
    }
    for (k = 1; k <= count; k++) {
        f = folder_of(name[k])
        x_of[k] = left[f] + margin + level[name[k]] * pitch
        # A column with fewer boxes than the frame has rows is centred.
        y_of[k] = frame_top[f] + head + (row[name[k]] + (height[f] - rows[f, level[name[k]]]) / 2) * (box_height + row_gap)
    }
    for (k = 1; k <= count; k++) for (m = 1; m <= count; m++)
        if (includes[name[k], name[m]] && !by_another(name[k], name[m]))
            line(x_of[k], y_of[k] + box_height / 2, x_of[m] + box_width + 1, y_of[m] + box_height / 2, "room")
    for (k = 1; k <= count; k++) {
        printf "<rect class=\"box\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"5\"/>\n", x_of[k], y_of[k], box_width, box_height
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n", x_of[k] + box_width / 2, y_of[k] + box_height / 2 + 5, name[k]
    }
    printf "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">an arrow leads to what is included</text>\n", total - 2 * margin, frame_top["core"] + frame_height["core"] - margin
    print "</svg>"
}
