# cmake -D FOLDER=viewer -D FILE=page.cpp -P EmbedViewer.cmake: makes one page from the sources in viewer/, as a string
# of C++ (io/view/view_page.hpp). Modules are joined in the order below. The exports of a module are then known to all
# modules after it, so import lines are removed, and no two modules may define the same name at top level.
set(page_modules format shear store colours camera disk_renderer overlay playback picking picture plots panel controls viewer
  main)
set(worker_modules decode worker)

function(join_modules result)
  set(joined "")
  foreach(module IN LISTS ARGN)
    file(READ ${FOLDER}/${module}.js text)
    string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
    string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
    # Comments are removed, and so is the white space at the start of a line.
    string(REGEX REPLACE "\n *//[^\n]*" "" text "\n${text}")
    string(REGEX REPLACE "([;,{]) // [^\n]*" "\\1" text "${text}")
    string(REGEX REPLACE "\n[ \n]*" "\n" text "${text}")
    # Spaces around operators are removed if no text of the page contains them; texts contain " = ${".
    string(REGEX REPLACE " (=>|[!=]==|&&|[|][|]|[-+*/]=|[<>]=?|\\*|[?:+]) " "\\1" text "${text}")
    string(REGEX REPLACE " = ([^$])" "=\\1" text "${text}")
    string(REGEX REPLACE "([^a-zA-Z])(if|for) \\(" "\\1\\2(" text "${text}")
    string(REGEX REPLACE "\\) {\n" "){\n" text "${text}")
    # So are spaces at brackets, and after commas before a bracket or before the last item in brackets.
    string(REGEX REPLACE "([^$]{) " "\\1" text "${text}")
    string(REGEX REPLACE " }" "}" text "${text}")
    string(REGEX REPLACE "([])],) " "\\1" text "${text}")
    string(REGEX REPLACE ", ([[({])" ",\\1" text "${text}")
    string(REGEX REPLACE "([a-zA-Z0-9],) ([a-zA-Z0-9]+[)])" "\\1\\2" text "${text}")
    string(REGEX REPLACE "(const|return|else) ([[{])" "\\1\\2" text "${text}")
    string(APPEND joined "${text}")
  endforeach()
  set(${result} "\n\"use strict\";\n(() => {\n${joined}})();\n" PARENT_SCOPE)
endfunction()

# A hash as the content security policy needs it, its bytes in base64. Six hexadecimal digits make four letters.
function(policy_hash result text)
  string(SHA256 hex "${text}")
  string(APPEND hex "00")
  set(letters ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  set(hash "")
  foreach(at RANGE 0 63 3)
    string(SUBSTRING ${hex} ${at} 3 digits)
    math(EXPR high "0x${digits} >> 6")
    math(EXPR low "0x${digits} & 63")
    string(SUBSTRING ${letters} ${high} 1 first)
    string(SUBSTRING ${letters} ${low} 1 second)
    string(APPEND hash ${first}${second})
  endforeach()
  string(SUBSTRING ${hash} 0 43 hash)
  set(${result} "'sha256-${hash}='" PARENT_SCOPE)
endfunction()

file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/style.css style)
set(style "\n${style}")
foreach(text page style)
  string(REGEX REPLACE "\n[ \n]+" "\n" ${text} "${${text}}")
endforeach()
string(REGEX REPLACE "([;:{,]) " "\\1" style "${style}")
string(REGEX REPLACE " ([{}])" "\\1" style "${style}")
join_modules(script ${page_modules})
join_modules(worker ${worker_modules})
join_modules(live live)
policy_hash(style_hash "${style}")
policy_hash(script_hash "${script}")
policy_hash(live_hash "${live}")
foreach(name style_hash script_hash style script worker)
  string(REPLACE "<!--embed:${name}-->" "${${name}}" page "${page}")
endforeach()
string(LENGTH "${page}" length)
if(length GREATER 61440)
  message(FATAL_ERROR "the page of viewer/ has ${length} bytes; it should stay under 60 KB")
endif()
if(page MATCHES "<!--embed:")
  message(FATAL_ERROR "viewer/page.html asks for something that cmake/EmbedViewer.cmake does not have")
endif()
# The additional policy for the page of a run that is going on: it may send requests to its own server only.
set(policy " ${live_hash}; connect-src 'self'")
file(WRITE ${FILE} "#include \"io/view/view_page.hpp\"\n\nnamespace carom {\n
const char* const viewer_page = R\"__page(${page})__page\";
const char* const viewer_live_policy = R\"__page(${policy})__page\";
const char* const viewer_live_script = R\"__page(<script>${live}</script>\n)__page\";\n
}  // namespace carom\n")
