export const LINES = {
    motion: /^\s*(?:S?PTP|S?LIN|S?CIRC|SPL)(?:_REL)?\b/i,
    opens: /^\s*(?:IF|FOR|LOOP|WHILE|REPEAT|SWITCH|SPLINE|PTP_SPLINE)\b/i,
    parts: /^\s*(?:ELSE|CASE|DEFAULT)\b/i,
    closes: /^\s*(?:ENDIF|ENDFOR|ENDLOOP|ENDWHILE|UNTIL|ENDSWITCH|ENDSPLINE)\b/i,
    keeps: /^\s*(?:GLOBAL\s+)?(?:DEF|DEFFCT|DEFDAT|END|ENDFCT|ENDDAT)\b/i,
};
